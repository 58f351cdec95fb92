// How far each cell of an occupancy grid is from the nearest surface, and on which side of it.
// Based on: Rosenfeld and Pfaltz, Distance Functions on Digital Pictures (1968): chessboard distance in two sweeps.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "scene/occupancy.h"

namespace lamp::app {

struct SurfaceDistance {
  /// Steps to the nearest solid cell, where a step may be diagonal; 0: solid, 255: as far or farther, or no solid cell.
  std::vector<std::uint8_t> steps;
  /// 1: the nearest surfaces are seen from behind, as the inside of a solid or the outside of a room does.
  std::vector<std::uint8_t> behind;
};

/// Both, for every cell but the border.
[[nodiscard]] SurfaceDistance find_surface_distance(const Occupancy& grid);

}  // namespace lamp::app
