// Area lights, culled as a point light or a spot around all that they reach. Shading them is the host's.
// Based on: what a surface reaches within a distance is a Minkowski sum of both; the least sphere around it is that of
// the surface, larger by the distance. What shines from one face reaches half of it: a spot of 90 degrees.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lamplight/export.h"
#include "lamplight/light.h"

namespace lamp {

/// From which faces a flat light shines.
enum class Faces : std::uint8_t {
  both,
  front,  ///< on the side that its normal looks to alone
};

/// A parallelogram in world space. Its normal is that of cross(half_x, half_y).
struct RectangleLight {
  Vec3 center{};                  ///< m
  Vec3 half_x{0.5F, 0.0F, 0.0F};  ///< m, from the centre to the middle of an edge
  Vec3 half_y{0.0F, 0.5F, 0.0F};  ///< m, from the centre to the middle of the next edge
  Faces faces = Faces::both;
};

/// A disc in world space.
struct DiscLight {
  Vec3 center{};                  ///< m
  Vec3 normal{0.0F, 0.0F, 1.0F};  ///< any length but 0; Faces::both leaves it unread
  float radius = 0.5F;            ///< m, >= 0
  Faces faces = Faces::both;
};

/// A tube in world space, with ends that are flat or half balls beyond `from` and `to`.
struct TubeLight {
  Vec3 from{};                ///< m, on the axis
  Vec3 to{1.0F, 0.0F, 0.0F};  ///< m
  float radius = 0.0F;        ///< m, >= 0; 0: a line
};

/// A light that reaches every point whose distance from the nearest point of the surface is less than `range` (m, >= 0,
/// may be infinite; 0 reaches nothing). A spot of 90 degrees where only the front shines, else a point light. No lesser
/// sphere holds all of it, but for rounding, and for a tube's with flat ends. Colour and intensity are Light's
/// defaults, which culling does not read. What is wrong with a shape or a range is wrong with the light
/// (`check_lights`).
[[nodiscard]] LAMPLIGHT_API Light bounding_light(const RectangleLight& shape, float range);
[[nodiscard]] LAMPLIGHT_API Light bounding_light(const DiscLight& shape, float range);
[[nodiscard]] LAMPLIGHT_API Light bounding_light(const TubeLight& shape, float range);

}  // namespace lamp
