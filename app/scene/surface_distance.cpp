// Distance to surfaces: cells beside a surface vote on their side of it, two sweeps carry distance and side outwards.
// Based on: Rosenfeld and Pfaltz, Distance Functions on Digital Pictures (1968).
// SPDX-License-Identifier: Apache-2.0
#include "scene/surface_distance.h"

#include <array>
#include <cstddef>
#include <span>

namespace lamp::app {
namespace {

constexpr std::uint8_t FAR = 255;

// Behind a surface: the facing of the solid neighbours, summed along the way to the cell, is this part of what it
// could be at most, and negative. Both sides of a thin wall cancel out; its neighbours count as in front.
constexpr float BEHIND = -0.25F;

struct Neighbour {
  std::ptrdiff_t step = 0;  // in the cells' array
  glm::ivec3 way{0};
};

// The 26 neighbours; the first 13 come before a cell in the array, the last 13 after it, in opposite order.
std::array<Neighbour, 26> neighbours_of(const Occupancy& grid) {
  std::array<Neighbour, 26> neighbours;
  std::size_t count = 0;
  for (int i = 0; i < 27; ++i) {
    const glm::ivec3 way(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    if (way == glm::ivec3(0)) continue;
    const std::ptrdiff_t step = (static_cast<std::ptrdiff_t>(way.z) * grid.size.y + way.y) * grid.size.x + way.x;
    neighbours[count++] = {step, way};
  }
  return neighbours;
}

struct Vote {
  float front = 0.0F;
  float most = 0.0F;
};

// Cells beside solid ones: distance 1, and the side that the surfaces there show them.
void start_beside_surfaces(const Occupancy& grid, std::span<const Neighbour> neighbours, SurfaceDistance& result) {
  std::vector<Vote> votes(grid.solid.size());
  for (std::size_t i = 0; i < grid.solid.size(); ++i) {
    if (grid.solid[i] == 0) continue;
    const glm::vec3 facing(grid.facing[i]);
    for (const Neighbour& neighbour : neighbours) {
      const std::size_t next = i + static_cast<std::size_t>(neighbour.step);
      if (grid.solid[next] != 0) continue;
      result.steps[next] = 1;
      votes[next].front += glm::dot(facing, glm::vec3(neighbour.way));
      votes[next].most += glm::length(facing);
    }
  }
  for (std::size_t i = 0; i < votes.size(); ++i) {
    result.behind[i] = votes[i].front < BEHIND * votes[i].most ? 1 : 0;
  }
}

void take_from(std::span<const Neighbour> passed, std::size_t i, SurfaceDistance& result) {
  for (const Neighbour& neighbour : passed) {
    const std::size_t other = i + static_cast<std::size_t>(neighbour.step);
    if (result.steps[other] + 1 >= result.steps[i]) continue;
    result.steps[i] = static_cast<std::uint8_t>(result.steps[other] + 1);
    result.behind[i] = result.behind[other];
  }
}

}  // namespace

SurfaceDistance find_surface_distance(const Occupancy& grid) {
  const auto neighbours = neighbours_of(grid);
  SurfaceDistance result{.steps = std::vector<std::uint8_t>(grid.solid.size(), FAR),
                         .behind = std::vector<std::uint8_t>(grid.solid.size(), 0)};
  start_beside_surfaces(grid, neighbours, result);
  for (std::size_t i = 0; i < grid.solid.size(); ++i) {
    if (grid.solid[i] != 0) result.steps[i] = 0;
  }
  const auto sweep_row = [&](int y, int z, bool forward) {
    const std::size_t row = grid.index({0, y, z});
    const auto passed = std::span(neighbours).subspan(forward ? 0 : 13, 13);
    for (int x = 1; x <= grid.size.x - 2; ++x) {
      take_from(passed, row + static_cast<std::size_t>(forward ? x : grid.size.x - 1 - x), result);
    }
  };
  const glm::ivec3 last = grid.size - 2;
  for (int z = 1; z <= last.z; ++z) {
    for (int y = 1; y <= last.y; ++y) sweep_row(y, z, /* forward= */ true);
  }
  for (int z = last.z; z >= 1; --z) {
    for (int y = last.y; y >= 1; --y) sweep_row(y, z, /* forward= */ false);
  }
  return result;
}

}  // namespace lamp::app
