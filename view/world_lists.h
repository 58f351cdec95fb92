// Lists of points of the world: at the picked surface, at what its mirrored ray meets, and in the cells around. Drawn
// as boxes.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace lamp::app {

/// The list that a look-up by position finds.
struct PointList {
  std::string_view what;  ///< "surface", "mirrored"
  glm::vec3 position{0.0F};
  std::size_t walked = 0;
  std::size_t reaching = 0;  ///< of them, those that reach the point, says the oracle
  std::size_t missed = 0;    ///< that reach it and are not listed
  bool ended = false;        ///< by the device before its end
};

/// A cube; all its points have one list.
struct WorldCell {
  glm::vec3 low{0.0F};
  float side = 0.0F;
  std::uint32_t lights = 0;
};

struct ShownWorld {
  std::string refused;  ///< why there are no lists, or no cells
  std::string method;   ///< whose lists they are
  std::vector<PointList> points;
  std::vector<WorldCell> cells;  ///< around the surface
  std::uint32_t longest = 0;     ///< of the cells
};
inline constexpr int CELLS_AROUND = 2;  ///< to each side along each axis

}  // namespace lamp::app
