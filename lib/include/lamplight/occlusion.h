// What stands in a still light's way, for lists that are made ahead: which points it surely does not see.
// Based on: Durand et al., Conservative Visibility Preprocessing Using Extended Projections, SIGGRAPH (2000): what one
// convex occluder covers, proved; here for a point, texel by texel of a cube.
// Promise: pure code, no device. What `hides` says is hidden, is: every ray from the light to it meets a triangle well
// before it. What is not proved is not hidden.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "lamplight/export.h"
#include "lamplight/vectors.h"

namespace lamp {

/// World space, m; both sides count.
using OccluderTriangle = std::array<DVec3, 3>;

/// The opaque triangles of what stands still. Those that share edges and lie in a plane become convex polygons, as
/// large as they get; a hierarchy of boxes finds the ones near a light.
class LAMPLIGHT_API StillOccluders {
 public:
  /// Give triangles that nothing passes: no glass, nothing that an image cuts out. Corners that triangles share must be
  /// the same numbers; where they are not, triangles stay apart, which hides less. Triangles without area or with a
  /// corner that is not finite hide nothing.
  explicit StillOccluders(std::span<const OccluderTriangle> triangles);
  StillOccluders(StillOccluders&&) noexcept;
  StillOccluders& operator=(StillOccluders&&) noexcept;
  ~StillOccluders();

  [[nodiscard]] std::size_t polygons() const;
  [[nodiscard]] std::size_t left_out() const;  ///< triangles that hide nothing

  /// Points spread evenly over the polygons' part of a box, at most as many.
  [[nodiscard]] std::vector<DVec3> points_on(const DVec3& min, const DVec3& max, std::size_t count) const;

 private:
  friend class OcclusionMap;
  struct State;
  std::unique_ptr<State> state_;
};

/// A point that looks around, and how far at least it sees nothing any more: a cube of directions whose texels hold a
/// distance beyond which all of the texel lies behind one and the same polygon.
class LAMPLIGHT_API OcclusionMap {
 public:
  /// Texels a side of each of the six faces, >= 1. Nothing hides anything until `look`.
  explicit OcclusionMap(std::uint32_t resolution);

  /// From a light's position, at what may lie nearer than its range (m; infinite: at everything). Made anew; the memory
  /// is kept.
  void look(const StillOccluders& occluders, const Vec3& position, float range);

  /// `look` at once.
  [[nodiscard]] static OcclusionMap of(const StillOccluders& occluders, const Vec3& position, float range,
                                       std::uint32_t resolution) {
    OcclusionMap map(resolution);
    map.look(occluders, position, range);
    return map;
  }

  /// True only where the light sees no point of the convex hull of these corners: each lies behind a polygon, farther
  /// from the light than it by more than HIDDEN_BEYOND. The hull is widened by what 32-bit arithmetic rounds. Three
  /// corners are a triangle, of others their box along the axes counts. False without corners, or if one is not finite.
  [[nodiscard]] bool hides(std::span<const DVec3> corners) const;
  /// Of a box along the axes.
  [[nodiscard]] bool hides(const DVec3& min, const DVec3& max) const;

  /// Of a box along the axes: false wherever `hides` may be true of a part of it, so that parts need not be asked.
  [[nodiscard]] bool surely_sees(const DVec3& min, const DVec3& max) const;

  /// Whether any direction is stopped at all.
  [[nodiscard]] bool hides_anything() const { return hides_anything_; }
  [[nodiscard]] std::uint32_t resolution() const { return resolution_; }

  /// Of the distance: a point of an occluder's own surface is not hidden by it, nor by a copy of it that is as near.
  static constexpr double HIDDEN_BEYOND = 1e-4;

 private:
  struct Hull;
  struct Part;
  void draw(const StillOccluders::State& occluders, std::uint32_t polygon);
  [[nodiscard]] bool hides(const Hull& hull) const;
  [[nodiscard]] std::optional<Part> part_in(const Hull& hull, std::uint32_t face) const;
  [[nodiscard]] bool face_hides(const Hull& hull, std::uint32_t face) const;
  [[nodiscard]] bool face_surely_sees(const Hull& hull, std::uint32_t face) const;

  std::uint32_t resolution_;
  DVec3 position_{};
  bool hides_anything_ = false;
  std::vector<float> nearness_;        ///< of each texel: 1 / the distance along the face's axis; 0: nothing covers it
  std::vector<std::uint32_t> planes_;  ///< and which of `seen_` covers it
  std::vector<DVec3> seen_;            ///< planes: dot with a position from the light is at least 1 behind it
};

}  // namespace lamp
