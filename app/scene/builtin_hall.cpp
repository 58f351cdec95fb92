// The hall, and three adversarial scenes in it: one-tile, needles, huge-and-tiny.
// Based on: nothing; two rows of columns, an altar at the far end.
// Promise: closed; for the first camera all of one-tile's lights reach no further than one tile of 16 or 32 pixels, at
// 1920x1080 and at 3840x2160.
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "scene/builtin_scenes.h"
#include "scene/mesh_builder.h"
#include "scene/procedural_textures.h"

namespace lamp::app::procedural {
namespace {

constexpr glm::vec3 HALL_MIN{-8.0F, 0.0F, -44.0F};
constexpr glm::vec3 HALL_MAX{8.0F, 8.0F, 4.0F};
constexpr glm::vec3 EYE{0.0F, 1.7F, 0.0F};
constexpr float FOV_Y = 1.0F;

// Where the first camera sees the swarm, as parts of a 16:9 picture from the top left. A third of a tile or more away
// from every tile's border at the sizes of the promise: 59 1/3 tiles of 16 pixels in 120, 33 1/3 in 67 1/2.
constexpr glm::vec2 SWARM_AT{(59.0F + 1.0F / 3.0F) / 120.0F, (33.0F + 1.0F / 3.0F) / 67.5F};
constexpr float SWARM_Z = -38.0F;
constexpr float SWARM_M = 0.1F;  // its sides, and twice the largest range: 2.6 pixels at 1080p

struct Materials {
  std::uint32_t floor, wall, ceiling, column, beam, altar, metal;
};

Materials add_materials(Scene& scene) {
  Materials m{};
  m.floor = add_material(
      scene, use_surface(scene, floor_tiles({0.42F, 0.4F, 0.36F}, {0.2F, 0.19F, 0.18F}, {0.09F, 0.1F, 0.12F})));
  m.wall = add_material(scene, use_surface(scene, stone_blocks({0.5F, 0.45F, 0.38F})));
  m.ceiling = add_material(scene, use_surface(scene, plaster({0.5F, 0.5F, 0.52F})));
  m.column = add_material(scene, use_surface(scene, marble({0.6F, 0.58F, 0.52F})));
  m.beam = add_material(scene, use_surface(scene, planks({0.3F, 0.2F, 0.12F})));
  m.altar = add_material(scene, use_surface(scene, bricks()));
  m.metal = add_material(scene, use_surface(scene, worn_metal("bronze", {0.6F, 0.42F, 0.22F})));
  return m;
}

void add_shell(Scene& scene, const Materials& m) {
  const glm::vec3 a = HALL_MIN;
  const glm::vec3 b = HALL_MAX;
  Geometry floor;
  add_quad(floor, {a.x, a.y, b.z}, {b.x, a.y, b.z}, {b.x, a.y, a.z}, {a.x, a.y, a.z});
  add_once(scene, floor, m.floor);
  Geometry ceiling;
  add_quad(ceiling, {a.x, b.y, a.z}, {b.x, b.y, a.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z});
  add_once(scene, ceiling, m.ceiling);
  Geometry walls;
  add_quad(walls, {a.x, a.y, a.z}, {b.x, a.y, a.z}, {b.x, b.y, a.z}, {a.x, b.y, a.z});
  add_quad(walls, {b.x, a.y, b.z}, {a.x, a.y, b.z}, {a.x, b.y, b.z}, {b.x, b.y, b.z});
  add_quad(walls, {a.x, a.y, b.z}, {a.x, a.y, a.z}, {a.x, b.y, a.z}, {a.x, b.y, b.z});
  add_quad(walls, {b.x, a.y, a.z}, {b.x, a.y, b.z}, {b.x, b.y, b.z}, {b.x, b.y, a.z});
  add_once(scene, walls, m.wall);
}

void add_columns(Scene& scene, const Materials& m) {
  constexpr std::array<glm::vec2, 8> PROFILE{{{0.55F, 0.0F},
                                              {0.55F, 0.25F},
                                              {0.4F, 0.4F},
                                              {0.36F, 4.0F},
                                              {0.33F, 7.0F},
                                              {0.5F, 7.25F},
                                              {0.6F, 7.3F},
                                              {0.6F, 7.6F}}};
  Geometry column;
  add_lathe(column, {.profile = PROFILE, .segments = 20});
  const std::uint32_t mesh = add_mesh(scene, column, m.column);
  Geometry beams;
  for (int i = 0; i < 9; ++i) {
    const float z = 0.5F - 5.0F * static_cast<float>(i);
    for (const float x : {-4.5F, 4.5F}) place(scene, mesh, at(x, 0, z));
    add_box(beams, {HALL_MIN.x - 0.1F, 7.55F, z - 0.3F}, {HALL_MAX.x + 0.1F, 8.1F, z + 0.3F});
  }
  add_once(scene, beams, m.beam);
}

glm::vec3 swarm_center() {
  const float up = std::tan(0.5F * FOV_Y);
  const float depth = EYE.z - SWARM_Z - 0.5F * SWARM_M;
  return EYE +
         depth * glm::vec3((2.0F * SWARM_AT.x - 1.0F) * up * 16.0F / 9.0F, (1.0F - 2.0F * SWARM_AT.y) * up, -1.0F);
}

/// A stele whose front is right behind the swarm, on steps.
void add_altar(Scene& scene, const Materials& m) {
  const float x = swarm_center().x;
  Geometry steps;
  for (int i = 0; i < 3; ++i) {
    const float out = 2.4F - 0.6F * static_cast<float>(i);
    const float y = 0.25F * static_cast<float>(i);
    add_box(steps, {x - out, y - 0.05F, SWARM_Z - 0.3F - out}, {x + out, y + 0.25F, SWARM_Z - 0.3F + out});
  }
  add_once(scene, steps, m.altar);
  Geometry stele;
  add_box(stele, {x - 0.35F, 0.7F, SWARM_Z - 0.6F}, {x + 0.35F, 2.6F, SWARM_Z});
  add_once(scene, stele, m.metal);
}

Scene make_hall(const std::string& name) {
  Scene scene;
  scene.name = name;
  scene.sky = {0.01F, 0.012F, 0.02F};
  scene.ambient = {0.05F, 0.052F, 0.06F};
  const Materials m = add_materials(scene);
  add_shell(scene, m);
  add_columns(scene, m);
  add_altar(scene, m);
  scene.cameras = {camera_at("nave", EYE, EYE - glm::vec3(0, 0, 10), FOV_Y),
                   camera_at("aisle", {-6.6F, 2.4F, 2.0F}, {3.0F, 2.0F, -22.0F}, FOV_Y)};
  Flight flight{.fov_y = FOV_Y};
  for (int i = 0; i < 12; ++i) {  // an oval near the entrance, always towards the altar
    const float turn = static_cast<float>(i) / 12.0F * 2.0F * std::numbers::pi_v<float>;
    flight.keys.push_back(
        {.eye = EYE + glm::vec3(2.5F * std::sin(turn), 0.3F * std::sin(2.0F * turn), -2.0F * std::cos(turn)),
         .target = swarm_center()});
  }
  scene.flight = flight;
  return scene;
}

}  // namespace

Scene make_one_tile() {
  Scene scene = make_hall("one-tile");
  const glm::vec3 center = swarm_center();
  scene.placement.box = Box{center - 0.5F * SWARM_M, center + 0.5F * SWARM_M};
  scene.placement.max_range = 0.5F * SWARM_M;
  scene.cameras.push_back(camera_at("swarm", center + glm::vec3(0.1F, 0.1F, 0.45F), center, FOV_Y));
  return scene;
}

Scene make_huge_and_tiny() {
  Scene scene = make_hall("huge-and-tiny");
  std::swap(scene.cameras[0], scene.cameras[1]);
  scene.placement.range_ratio = 1e4F;
  return scene;
}

Scene make_needles() {
  Scene scene = make_hall("needles");
  scene.placement.spot_angle = 0.5F * std::numbers::pi_v<float> / 180.0F;
  scene.placement.spot_reach = 8.0F;
  return scene;
}

}  // namespace lamp::app::procedural
