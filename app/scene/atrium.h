// Inside the atrium: its measures, its materials and its two halves, the building and what stands and hangs in it.
// Based on: nothing; a cloister of 10 by 5 bays around a court of 8 by 3, after Romanesque and Ottoman courtyards.
// Promise: all measures in metres; the court is centred on the origin, its long side runs along x.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/scene.h"

namespace lamp::app::procedural::atrium {

inline constexpr float BAY_X = 3.2F;
inline constexpr float BAY_Z = 2.8F;
inline constexpr glm::vec2 COURT{12.8F, 4.2F};  ///< half sizes to the column lines, x and z
inline constexpr glm::vec2 OUTER{16.0F, 7.0F};  ///< half sizes to the outer walls' inner faces
inline constexpr float AISLE_Y = 0.15F;         ///< the ground floor behind the columns
inline constexpr float SPRING_Y = 3.55F;        ///< where the lower arches begin
inline constexpr float SLAB_Y = 5.25F;          ///< underside of the gallery
inline constexpr float GALLERY_Y = 5.55F;
inline constexpr float UPPER_SPRING_Y = 8.55F;
inline constexpr float EAVES_Y = 10.3F;

/// Numbers of the scene's materials.
struct Materials {
  std::uint32_t wall, trim, column, court_floor, aisle_floor, plaster, wood, roof;
  std::uint32_t fretwork, leaves, terracotta, bronze, water, glass, veil, lamp, red_cloth;
  std::vector<std::uint32_t> banners;
};

/// The middle of a bay on a rectangle of bays; after a turn, +z points away from the court.
struct Bay {
  glm::vec3 middle{0.0F};
  float turn = 0.0F;  ///< radians around +Y
  bool along_x = true;
  int number = 0;  ///< along its side
};

/// The bays of the rectangle of `count_x` by `count_z` bays at half sizes `half`.
[[nodiscard]] std::vector<Bay> bays_around(int count_x, int count_z, glm::vec2 half);

/// Floors, columns, arches, vaults, walls, gallery, roof.
void add_building(Scene& scene, const Materials& materials);
void add_columns(Scene& scene, const Materials& materials);

/// Fountain, vases, plants, lanterns, banners, veils.
void add_decor(Scene& scene, const Materials& materials);
void add_cloths(Scene& scene, const Materials& materials);

/// What `--decals` shows; not drawn unless asked for.
void add_decals(Scene& scene);

inline constexpr glm::vec2 BANNER_M{1.5F, 3.6F};

}  // namespace lamp::app::procedural::atrium
