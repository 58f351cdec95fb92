// A coarse grid over a scene that knows which cells any triangle touches, and which way those triangles face.
// Based on: Schwarz and Seidel, Fast Parallel Surface and Solid Voxelization on GPUs, SIGGRAPH Asia 2010, section 4.
// Promise: conservative; a cell that is not solid holds no part of any triangle.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/scene.h"

namespace lamp::app {

/// Cubic cells over the scene's bounds and some air above them, with one border cell on every side.
struct Occupancy {
  glm::vec3 origin{0.0F};  ///< m, world space: the corner of cell (0, 0, 0)
  float cell_m = 1.0F;
  glm::ivec3 size{0};               ///< cells a side, border included
  float near_m = 0.0F;              ///< how far from surfaces "near them" reaches in a scene of this size; m
  std::vector<std::uint8_t> solid;  ///< 1: a triangle touches the cell
  std::vector<glm::ivec3> facing;   ///< sum over the cell's one-sided triangles: normal times area (at most 1 cell)

  [[nodiscard]] std::size_t index(const glm::ivec3& cell) const {
    return (static_cast<std::size_t>(cell.z) * size.y + cell.y) * size.x + cell.x;
  }
  [[nodiscard]] glm::ivec3 cell(std::size_t index) const {
    const auto i = static_cast<std::int64_t>(index);
    return {i % size.x, i / size.x % size.y, i / (std::int64_t{size.x} * size.y)};
  }
  /// Inside the grid and not in its border.
  [[nodiscard]] bool inner(const glm::ivec3& cell) const {
    return glm::all(glm::greaterThan(cell, glm::ivec3(0))) && glm::all(glm::lessThan(cell, size - 1));
  }
};

/// The unit of Occupancy::facing: a triangle as large as a side of a cell.
inline constexpr float FACING_UNIT = 1024.0F;

/// The grid of a scene: at most about two million cells, the longest side of the bounds 100 to 256 of them.
[[nodiscard]] Occupancy find_occupancy(const Scene& scene);

}  // namespace lamp::app
