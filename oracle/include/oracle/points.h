// The oracle at points of the world: which lights reach each of them, in double precision, on the CPU.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "oracle/occluders.h"
#include "oracle/reference.h"

namespace lamp {

/// The lights that surely reach each point, ascending.
struct PointTruth {
  std::vector<std::size_t> offsets{0};  ///< points + 1; point i has lights[offsets[i] .. offsets[i + 1])
  std::vector<std::uint32_t> lights;    ///< Reach::inside only
  std::uint64_t boundary_pairs = 0;     ///< pairs that were left out

  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t point) const {
    return std::span(lights).subspan(offsets[point], offsets[point + 1] - offsets[point]);
  }
};

/// Light by light and point by point, but for lights that surely miss a whole group of neighbouring points.
[[nodiscard]] PointTruth truth_at(std::span<const glm::vec3> points, std::span<const shared::Light> lights);

/// Of a share of the way from a light to a point, what stops the light: what is nearer than that to the point is the
/// point's own surface, which 32-bit positions may lie on either side of.
inline constexpr double STOPS_BEFORE = 1.0 - 5e-5;

/// Of a truth at points, the lights that see their point.
[[nodiscard]] PointTruth seen_at(const PointTruth& truth, std::span<const glm::vec3> points,
                                 std::span<const shared::Light> lights, const Occluders& occluders);

}  // namespace lamp
