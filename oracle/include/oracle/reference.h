// The oracle: which lights reach which pixels, in double precision, on the CPU.
// Every method is checked against it. It shares no code with any method.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "lamplight/entity.h"
#include "lamplight/light.h"
#include "lamplight/view.h"

namespace lamp {

/// Pairs of pixel and light closer than this (relative) to the light's boundary are not checked.
inline constexpr double BOUNDARY_BAND = 1e-5;

/// How a position stands to a light's volume.
enum class Reach : std::uint8_t {
  outside,   ///< not reached
  boundary,  ///< within BOUNDARY_BAND of the range or of the cone: either answer is right
  inside,    ///< reached
};

/// A point light reaches what is nearer than its range; a spot, what is also inside its outer cone.
/// A range of 0 or an angle of 0 reaches nothing, one of 1e18 m and more everything (a spot: everything in its cone).
/// A spot's own position has no angle and counts as boundary.
[[nodiscard]] Reach reach(const shared::Light& light, const glm::dvec3& position_world);

/// A box reaches the positions inside it: along each axis, nearer to its centre than the half extent.
[[nodiscard]] Reach reach(const shared::OrientedBox& box, const glm::dvec3& position_world);

/// The same of a box or an ellipsoid: in the latter's space, scaled to a unit sphere, nearer to its centre than 1.
[[nodiscard]] Reach reach(const shared::OrientedBox& box, EntityShape shape, const glm::dvec3& position_world);

/// The entities that surely reach each pixel of some rows, pixel after pixel, ascending: lights, if nothing else is
/// said.
struct Truth {
  std::uint32_t first_row = 0;
  std::uint32_t rows = 0;
  std::vector<std::uint32_t> offsets;  ///< rows * width + 1; pixel i has lights[offsets[i] .. offsets[i + 1])
  std::vector<std::uint32_t> lights;   ///< Reach::inside only
  std::uint64_t boundary_pairs = 0;    ///< pairs that were left out
};

/// Rows of a picture to answer for. `depth` holds device depth of the whole picture, row by row; 0 is sky and
/// is reached by nothing. An answer holds less than 2^32 pairs: rows * width * entities below that is always enough,
/// ask for fewer rows at a time otherwise.
struct TruthQuery {
  const View& view;
  std::span<const float> depth;
  std::span<const shared::Light> lights;
  std::uint32_t first_row = 0;
  std::uint32_t rows = 0;
  std::span<const shared::OrientedBox> boxes;  ///< their ids follow those of the lights
  std::span<const EntityShape> shapes;         ///< of the boxes, one each; none: all are boxes
  std::uint32_t first_id = 0;                  ///< of the first light; not 0 to ask for the boxes of a frame alone
};

/// Of one of the boxes.
[[nodiscard]] EntityShape shape_of(const TruthQuery& query, std::size_t box);

/// The truth, light by light and pixel by pixel. Slow: rows * width * lights.
[[nodiscard]] Truth brute_force_truth(const TruthQuery& query);

/// The same truth, sooner: blocks of pixels first discard the lights whose sphere misses the block's box.
[[nodiscard]] Truth truth(const TruthQuery& query);

}  // namespace lamp
