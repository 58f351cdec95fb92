// Inside the corridor scene: its plan, its materials, and its two halves, the building and the furniture.
// Based on: nothing.
// Promise: metres; the corridor runs along x between z = -1.4 and 1.4, rooms lie on both sides, a hall at its end.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "scene/scene.h"

namespace lamp::app::procedural::corridor {

inline constexpr int ROOMS = 5;         ///< on each side
inline constexpr float ROOM_M = 6.0F;   ///< along x
inline constexpr float WALL_Z = 1.4F;   ///< middle of the corridor's walls
inline constexpr float WALL_M = 0.2F;   ///< thickness
inline constexpr float OUTER_Z = 6.6F;  ///< inner faces of the outer walls
inline constexpr float END_X = 30.0F;   ///< where the rooms end and the hall begins
inline constexpr float HALL_X = 38.0F;
inline constexpr float HEIGHT_M = 2.8F;
inline constexpr float DOOR_M = 1.1F;
inline constexpr float DOOR_Y = 2.15F;

struct Materials {
  std::uint32_t corridor_floor, wood_floor, carpet, tiles, plaster, warm_plaster, brick, concrete;
  std::uint32_t wood, dark_wood, frame, fabric, leather, metal, copper, white, grille, glass, lamp, leaves, clay, paper;
  std::array<std::uint32_t, 3> pictures;
};

/// The middle of a room's door along x, measured in the corridor; side is -1 (z < 0) or 1.
[[nodiscard]] inline float door_x(int room, int side) {
  constexpr std::array<float, ROOMS> SHIFT{{0.9F, -0.6F, 1.4F, 0.2F, -1.2F}};
  return (static_cast<float>(room) + 0.5F) * ROOM_M + static_cast<float>(side) * SHIFT[static_cast<std::size_t>(room)];
}

void add_building(Scene& scene, const Materials& materials);
void add_furniture(Scene& scene, const Materials& materials);

}  // namespace lamp::app::procedural::corridor
