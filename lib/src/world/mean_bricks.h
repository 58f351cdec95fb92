// How many bricks of a grid a sphere reaches.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

namespace lamp {

/// On average, of a sphere anywhere, whose bricks' side is `ratio` of its radius: the volume of points within a radius
/// of a cube, over the cube's (Steiner's formula).
[[nodiscard]] inline double mean_bricks(double ratio) {
  const double pi = std::numbers::pi;
  return 1 + 6 / ratio + 3 * pi / (ratio * ratio) + 4 * pi / 3 / (ratio * ratio * ratio);
}

}  // namespace lamp
