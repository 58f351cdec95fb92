// The city's buildings: lots in blocks, shops below, floors of windows above, set back towers, roofs.
// Based on: nothing.
// Promise: walls are whole windows wide and whole floors high, so that facades never cut a window.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "scene/blocks.h"
#include "scene/foliage.h"
#include "scene/mesh_builder.h"
#include "scene/procedural_random.h"
#include "scene/procedural_textures.h"

namespace lamp::app::procedural::blocks {
namespace {

constexpr float SHOP_M = 4.0F;  // height of the ground floor

/// What the buildings add to: one geometry for each material.
struct City {
  std::vector<Geometry> facades;
  Geometry shops, roofs, ledges, metal, red_lights;
};

/// A box of walls alone, `windows` cells wide (x and z), centred on `center`.
struct Walls {
  glm::vec2 center;
  glm::ivec2 windows;
  float bottom;
  float height;
  glm::vec2 uv;       ///< m, whole cells
  float grow = 0.0F;  ///< m, beyond the windows' size on every side
};

glm::vec2 half_size(const Walls& walls) { return glm::vec2(walls.windows) * (FACADE_CELL_M.x / 2.0F) + walls.grow; }

void add_walls(Geometry& geometry, const Walls& walls) {
  const glm::vec2 h = half_size(walls);
  const glm::vec3 c(walls.center.x, walls.bottom, walls.center.y);
  const glm::vec3 up(0, walls.height, 0);
  add_uv_quad(geometry, {c + glm::vec3(-h.x, 0, h.y), {2 * h.x, 0, 0}, up, walls.uv});
  add_uv_quad(geometry, {c + glm::vec3(h.x, 0, h.y), {0, 0, -2 * h.y}, up, walls.uv});
  add_uv_quad(geometry, {c + glm::vec3(h.x, 0, -h.y), {-2 * h.x, 0, 0}, up, walls.uv});
  add_uv_quad(geometry, {c + glm::vec3(-h.x, 0, -h.y), {0, 0, 2 * h.y}, up, walls.uv});
}

/// A frame around a building: from `in` metres inside its walls to `out` metres outside.
void add_ledge(Geometry& geometry, glm::vec2 center, glm::vec2 half, glm::vec2 in_out, glm::vec2 y) {
  Geometry frame;
  add_frame(frame, {half - in_out.x, half + in_out.y, glm::vec2(y.x), glm::vec2(y.y)});
  append(geometry, frame, at(center.x, 0, center.y));
}

/// The flat roof of a part with its parapet, and what stands on it.
void add_roof(City& city, Random& random, glm::vec2 center, glm::vec2 half, float y) {
  const glm::vec3 c(center.x, y, center.y);
  add_quad(city.roofs, c + glm::vec3(-half.x, 0, half.y), c + glm::vec3(half.x, 0, half.y),
           c + glm::vec3(half.x, 0, -half.y), c + glm::vec3(-half.x, 0, -half.y));
  add_ledge(city.ledges, center, half, {0.3F, 0.12F}, {y - 0.45F, y + 0.9F});
  const glm::vec2 room = half - 2.6F;
  if (room.x < 0.5F || room.y < 0.5F) return;
  const int count = 1 + static_cast<int>(random.below(3));
  for (int i = 0; i < count; ++i) {
    const float half_depth = random.between(0.8F, 1.6F);
    const float half_width = random.between(0.8F, 1.6F);
    const glm::vec2 half_box(half_width, half_depth);
    // One machine a strip of the roof, so that they cannot overlap.
    const float strip = 2.0F * room.x / static_cast<float>(count);
    const float x = -room.x + strip * (static_cast<float>(i) + 0.5F);
    const glm::vec2 p = center + glm::vec2(x, random.between(-room.y, room.y));
    const float wide = std::min(half_box.x, strip * 0.45F);
    add_box(i == 0 ? city.ledges : city.metal, {p.x - wide, y - 0.1F, p.y - half_box.y},
            {p.x + wide, y + random.between(1.0F, 2.6F), p.y + half_box.y});
  }
}

void add_antenna(City& city, const glm::vec3& foot, float height) {
  const std::array<glm::vec3, 2> path{{foot, foot + glm::vec3(0, height, 0)}};
  const std::array<float, 2> radii{{0.25F, 0.06F}};
  add_tube(city.metal, {.path = path, .radii = radii, .sides = 6});
  add_sphere(city.red_lights, path[1] + glm::vec3(0, 0.2F, 0), 0.3F, 8);
}

/// One building on a lot, at most as large as the lot.
void add_building(City& city, Random& random, glm::vec2 center, glm::vec2 lot_m) {
  const float distance = glm::length(center);
  const float downtown = std::exp(-distance * distance / (230.0F * 230.0F));
  const float luck = random.unit();
  int floors = 3 + static_cast<int>(random.below(6)) + static_cast<int>(42.0F * downtown * luck * luck);
  auto& facade =
      city.facades[floors > 16 ? random.below(2) : random.below(static_cast<std::uint32_t>(city.facades.size()))];
  glm::ivec2 windows = glm::max(glm::ivec2((lot_m - 0.8F) / FACADE_CELL_M.x), glm::ivec2(2));
  const std::uint32_t v = random.below(8);
  const std::uint32_t u = random.below(8);
  const glm::vec2 uv = glm::vec2(u, v) * FACADE_CELL_M;
  const Walls shop{center, windows, PAVEMENT_Y - 0.3F, SHOP_M + 0.3F, {uv.x, 0.3F}, 0.2F};
  add_walls(city.shops, shop);
  add_ledge(city.ledges, center, half_size(shop), {0.5F, 0.25F},
            {PAVEMENT_Y + SHOP_M - 0.1F, PAVEMENT_Y + SHOP_M + 0.3F});
  float y = PAVEMENT_Y + SHOP_M;
  while (floors > 0) {
    const bool steps_back = floors > 9 && windows.x > 6 && windows.y > 6;
    const int here = steps_back ? std::max(3, floors / 3) : floors;
    const Walls part{center, windows, y, static_cast<float>(here) * FACADE_CELL_M.y, uv};
    add_walls(facade, part);
    y += part.height;
    floors -= here;
    add_roof(city, random, center, half_size(part), y);
    if (floors == 0 && y > 90.0F) add_antenna(city, {center.x, y, center.y}, random.between(6.0F, 16.0F));
    windows -= 2 + 2 * static_cast<int>(random.below(2));
  }
}

}  // namespace

bool is_park(int i, int k) {
  const bool on_middle_street = k == BLOCKS_Z / 2 || k == BLOCKS_Z / 2 - 1;
  return !on_middle_street && hash_unit(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(k), 9) < 0.06F;
}

void add_buildings(Scene& scene, const Materials& m) {
  Random random(2024);
  City city;
  city.facades.resize(m.facades.size());
  for (int i = 0; i < BLOCKS_X; ++i) {
    for (int k = 0; k < BLOCKS_Z; ++k) {
      if (is_park(i, k)) continue;
      const glm::vec2 inner = BLOCK_M - 7.0F;
      const bool is_deep = random.chance(0.22F);
      const glm::ivec2 lots(1 + static_cast<int>(random.below(3)), is_deep ? 2 : 1);
      const glm::vec2 lot = inner / glm::vec2(lots);
      for (int x = 0; x < lots.x; ++x) {
        for (int z = 0; z < lots.y; ++z) {
          const glm::vec2 offset = (glm::vec2(x, z) + 0.5F) * lot - inner / 2.0F;
          add_building(city, random, block_at(i, k) + offset, lot);
        }
      }
    }
  }
  for (std::size_t i = 0; i < m.facades.size(); ++i) add_once(scene, city.facades[i], m.facades[i]);
  add_once(scene, city.shops, m.shops);
  add_once(scene, city.roofs, m.roof);
  add_once(scene, city.ledges, m.ledge);
  add_once(scene, city.metal, m.metal);
  add_once(scene, city.red_lights, m.red_light);
}

}  // namespace lamp::app::procedural::blocks
