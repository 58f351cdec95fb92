// Inside the city scene: its grid, its materials, and its two halves, buildings and streets.
// Based on: nothing.
// Promise: metres; crossings of streets lie at whole multiples of the pitch from the city's corner, one at the origin.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/scene.h"

namespace lamp::app::procedural::blocks {

inline constexpr int BLOCKS_X = 14;
inline constexpr int BLOCKS_Z = 18;
inline constexpr glm::vec2 BLOCK_M{64.0F, 48.0F};  ///< with its pavements, x and z
inline constexpr float STREET_M = 14.0F;
inline constexpr float CROSSING_M = 3.0F;
inline constexpr float PAVEMENT_Y = 0.15F;

struct Materials {
  std::vector<std::uint32_t> facades;
  std::uint32_t shops, pavement, asphalt, road, crossing, roof, ledge;
  std::uint32_t metal, rubber, glass, lamp, red_light, green_light, bark, leaves, grass;
  std::vector<std::uint32_t> paints;
};

/// The place of a crossing, 0 .. BLOCKS_X by 0 .. BLOCKS_Z.
[[nodiscard]] inline glm::vec2 crossing_at(int i, int k) {
  const glm::ivec2 from_middle(i - BLOCKS_X / 2, k - BLOCKS_Z / 2);
  return glm::vec2(from_middle) * (BLOCK_M + STREET_M);
}

/// The middle of a block.
[[nodiscard]] inline glm::vec2 block_at(int i, int k) { return crossing_at(i, k) + (BLOCK_M + STREET_M) / 2.0F; }

/// Some blocks are parks.
[[nodiscard]] bool is_park(int i, int k);

void add_buildings(Scene& scene, const Materials& materials);
void add_streets(Scene& scene, const Materials& materials);
void add_street_furniture(Scene& scene, const Materials& materials);

}  // namespace lamp::app::procedural::blocks
