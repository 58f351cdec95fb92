// Where in a scene generated lights may be: air that its cameras can be in, near its surfaces.
// Based on: flood filling a conservative occupancy grid (occupancy.h).
// Promise: no cell of the result touches a triangle, and the result is never empty.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/scene.h"

namespace lamp::app {

/// A cube of open air.
struct AirCell {
  glm::vec3 min{0.0F};          ///< m, world space: its low corner
  std::uint32_t clearance = 1;  ///< the nearest solid cell is so many cells away along some axis, >= 1
};

struct OpenAir {
  float cell_m = 1.0F;         ///< side of a cell
  float diagonal_m = 1.0F;     ///< of the scene's bounds
  std::vector<AirCell> cells;  ///< at least one
  LightPlacement placement;    ///< the scene's

  /// Cubic metres.
  [[nodiscard]] double volume() const { return static_cast<double>(cells.size()) * cell_m * cell_m * cell_m; }
};

/// The box of the scene's light placement, if it has one. Else the air that can be reached from the scene's cameras and
/// the keys of its flight without passing through a surface or behind one, as far as it lies near surfaces. Where that
/// is next to nothing: all such air near surfaces, but no air outdoors for cameras indoors. Of a captured frame: as
/// below.
[[nodiscard]] OpenAir find_open_air(const Scene& scene);

/// What a captured frame sees close before its surfaces.
[[nodiscard]] OpenAir find_open_air(const CapturedFrame& frame);

}  // namespace lamp::app
