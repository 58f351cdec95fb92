// A light that stands still against a convex part of a plane, in double precision.
// Promise: exact but for a widening by the slack and by what rounding of 32-bit numbers can move; never too small.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>

#include "lamplight/shared/light.h"

namespace lamp::world {

/// A corner of a part of a triangle, and the normal that shading interpolates there.
struct Corner {
  glm::dvec3 at{0.0};
  glm::dvec3 normal{0.0};
};

/// Convex, in one plane, corners in turn. A triangle cut by a rectangle has 7 at most; a cut may add some that
/// coincide.
struct Polygon {
  static constexpr std::size_t MOST = 16;
  std::array<Corner, MOST> corners;
  std::size_t count = 0;

  [[nodiscard]] std::span<const Corner> all() const { return std::span(corners).first(count); }
  void add(const Corner& corner) {
    if (count < MOST) corners[count++] = corner;
  }
};

struct Bounds {
  glm::dvec3 min{0.0};
  glm::dvec3 max{0.0};
};
[[nodiscard]] Bounds bounds_of(const Polygon& polygon);

/// The part of a polygon where `sign` times the coordinate along an axis is at most `limit`.
[[nodiscard]] Polygon cut(const Polygon& polygon, int axis, double sign, double limit);

struct StillLight {
  glm::dvec3 position{0.0};
  double range = 0.0;  ///< m; infinite: everything
  bool spot = false;
  glm::dvec3 axis{0.0};  ///< unit
  double cosine = 0.0;   ///< of half of the cone's angle, which is widened by rounding
  double sine = 0.0;
  glm::dvec3 center{0.0};
  double radius = 0.0;  ///< of a sphere around all that it reaches; negative: nothing
};
[[nodiscard]] StillLight still_light(const shared::Light& light);

/// Whether a sphere around the light's volume touches a box, and a spot's cone the sphere around that, both so much
/// wider.
[[nodiscard]] bool may_touch(const StillLight& light, const Bounds& box, double slack);

/// Whether the light's volume comes within `slack` of the polygon, whose plane has this unit normal (0: degenerate).
[[nodiscard]] bool touches(const StillLight& light, const Polygon& polygon, const glm::dvec3& plane, double slack);

/// Whether the light is behind all normals within `tilt` of an interpolated one, seen from all positions within `slack`
/// of the polygon that it reaches.
[[nodiscard]] bool is_behind(const StillLight& light, const Polygon& polygon, double tilt, double slack);

}  // namespace lamp::world
