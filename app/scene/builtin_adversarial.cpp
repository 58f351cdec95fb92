// Adversarial scenes with a geometry of their own: near-plane, wall and stack.
// Based on: nothing.
// Promise: no light of `wall` with an automatic range reaches a pixel of its first camera or its flight.
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <numbers>

#include "scene/builtin_scenes.h"
#include "scene/mesh_builder.h"
#include "scene/procedural_textures.h"

namespace lamp::app::procedural {
namespace {

constexpr float TURN = 2.0F * std::numbers::pi_v<float>;

struct Materials {
  std::uint32_t ground, brick, stone, wood, marble, metal, roof;
};

Materials add_materials(Scene& scene) {
  Materials m{};
  m.ground = add_material(scene, use_surface(scene, concrete({0.4F, 0.39F, 0.37F})));
  m.brick = add_material(scene, use_surface(scene, bricks()));
  m.stone = add_material(scene, use_surface(scene, stone_blocks({0.5F, 0.46F, 0.4F})));
  m.wood = add_material(scene, use_surface(scene, planks({0.42F, 0.28F, 0.16F})));
  m.marble = add_material(scene, use_surface(scene, marble({0.6F, 0.6F, 0.58F})));
  m.metal = add_material(scene, use_surface(scene, worn_metal("steel", {0.58F, 0.59F, 0.62F})));
  m.roof = add_material(scene, use_surface(scene, roof_tiles()));
  return m;
}

Scene night_scene(const std::string& name) {
  Scene scene;
  scene.name = name;
  scene.sky = {0.01F, 0.014F, 0.03F};
  scene.ambient = {0.04F, 0.043F, 0.052F};
  return scene;
}

void add_ground(Scene& scene, std::uint32_t material, glm::vec2 min, glm::vec2 max, float y) {
  Geometry ground;
  add_quad(ground, {min.x, y, max.y}, {max.x, y, max.y}, {max.x, y, min.y}, {min.x, y, min.y});
  add_once(scene, ground, material);
}

/// A small closed loop of the eye with a fixed target.
Flight sway(const glm::vec3& eye, const glm::vec3& amplitude, const glm::vec3& target) {
  constexpr int KEYS = 12;
  Flight flight;
  for (int i = 0; i < KEYS; ++i) {
    const float turn = TURN * static_cast<float>(i) / KEYS;
    const glm::vec3 swing(std::sin(turn), std::sin(2.0F * turn), std::cos(turn));
    flight.keys.push_back({.eye = eye + amplitude * swing, .target = target});
  }
  return flight;
}

// near-plane: a kiosk of posts, a desk right below the eye, a garden wall around.

constexpr glm::vec3 KIOSK_EYE{0.0F, 1.7F, 0.0F};

void add_kiosk(Scene& scene, const Materials& m) {
  Geometry post;
  add_cylinder(post, 0.035F, 0.0F, 3.0F, 10);
  const std::uint32_t mesh = add_mesh(scene, post, m.metal);
  for (int i = 0; i < 16; ++i) {
    const float turn = TURN * (static_cast<float>(i) + 0.5F) / 16.0F;
    place(scene, mesh, at(1.25F * std::sin(turn), 0, 1.25F * std::cos(turn)));
  }
  Geometry roof;
  constexpr std::array<glm::vec2, 4> PROFILE{{{0.0F, 2.9F}, {1.5F, 2.9F}, {1.5F, 3.0F}, {0.0F, 3.8F}}};
  add_lathe(roof, {.profile = PROFILE, .segments = 16});
  add_once(scene, roof, m.roof);
  Geometry desk;
  add_box(desk, {-0.8F, 1.05F, -1.0F}, {0.8F, 1.1F, -0.35F});
  for (const float x : {-0.7F, 0.7F}) add_box(desk, {x - 0.04F, 0.0F, -0.9F}, {x + 0.04F, 1.07F, -0.5F});
  add_once(scene, desk, m.wood);
  Geometry things;
  add_sphere(things, {-0.35F, 1.24F, -0.72F}, 0.15F, 24);
  add_box(things, {0.15F, 1.09F, -0.85F}, {0.5F, 1.2F, -0.6F});
  add_once(scene, things, m.marble);
}

void add_garden(Scene& scene, const Materials& m) {
  Geometry wall;
  add_frame(wall, {glm::vec2(5.0F), glm::vec2(5.4F), glm::vec2(-0.1F), glm::vec2(2.6F)});
  add_once(scene, wall, m.brick);
  Geometry pillars;
  for (const float x : {-3.4F, -1.2F, 1.2F, 3.4F}) {
    for (const float z : {-4.4F, 4.4F}) add_box(pillars, {x - 0.2F, -0.1F, z - 0.2F}, {x + 0.2F, 3.1F, z + 0.2F});
  }
  add_once(scene, pillars, m.stone);
}

// wall: it stands between the eye and a yard of columns.

constexpr float WALL_FRONT_Z = -4.0F;
constexpr float WALL_BACK_Z = -4.6F;
constexpr float YARD_GAP = 3.0F;  // m from the wall's back to the nearest light, and the largest range

void add_wall(Scene& scene, const Materials& m) {
  Geometry wall;
  add_box(wall, {-60.0F, -8.0F, WALL_BACK_Z}, {60.0F, 40.0F, WALL_FRONT_Z});
  add_once(scene, wall, m.brick);
  Geometry bands;
  for (const float y : {-2.4F, 0.6F, 3.6F}) {
    add_box(bands, {-59.0F, y, WALL_FRONT_Z - 0.1F}, {59.0F, y + 0.22F, WALL_FRONT_Z + 0.08F});
  }
  add_once(scene, bands, m.stone);
  Geometry piers;
  for (int i = -8; i <= 8; ++i) {
    const float x = 3.0F * static_cast<float>(i) + 1.5F;
    add_box(piers, {x - 0.25F, -7.0F, WALL_FRONT_Z - 0.1F}, {x + 0.25F, 20.0F, WALL_FRONT_Z + 0.2F});
  }
  add_once(scene, piers, m.marble);
}

void add_yard(Scene& scene, const Materials& m) {
  add_ground(scene, m.ground, {-24.0F, -48.0F}, {24.0F, WALL_BACK_Z}, -4.0F);
  Geometry column;
  add_cylinder(column, 0.5F, -4.1F, 8.0F, 20);
  const std::uint32_t mesh = add_mesh(scene, column, m.metal);
  for (int i = 0; i < 35; ++i) {
    const int row = i / 7;
    place(scene, mesh, at(7.0F * static_cast<float>(i % 7 - 3), 0, -11.0F - 8.0F * static_cast<float>(row)));
  }
  Geometry sheds;
  add_box(sheds, {-20.0F, -4.1F, -30.0F}, {-15.0F, 0.0F, -20.0F});
  add_box(sheds, {12.0F, -4.1F, -40.0F}, {19.0F, 2.0F, -34.0F});
  add_once(scene, sheds, m.wood);
}

// stack: layers of upright bars, all as wide and as far apart for the first camera.

constexpr glm::vec3 STACK_EYE{0.0F, 1.7F, 0.0F};
constexpr int LAYERS = 32;
constexpr float FIRST_LAYER_M = 3.0F;
constexpr float LAYERS_APART_M = 2.5F;
constexpr float BAR_WIDTH = 0.003F;   // over its distance: 3 pixels at 1080p
constexpr float BARS_APART = 0.024F;  // so that a layer hides an eighth of those behind it; 1 1/2 tiles of 16 pixels

void add_layer(Geometry& bars, int layer) {
  constexpr float HALF_WIDTH = 1.0F;  // of what a layer covers, over its distance
  constexpr float HALF_HEIGHT = 0.75F;
  const float d = FIRST_LAYER_M + LAYERS_APART_M * static_cast<float>(layer);
  const float phase = 0.618034F * static_cast<float>(layer);  // the golden ratio: no layer stands in another's gaps
  const auto count = static_cast<int>(2.0F * HALF_WIDTH / BARS_APART);
  const float low = std::max(-0.05F, STACK_EYE.y - HALF_HEIGHT * d);
  for (int i = 0; i < count; ++i) {
    const float x = d * (BARS_APART * (static_cast<float>(i) + phase - std::floor(phase)) - HALF_WIDTH);
    const float half = 0.5F * BAR_WIDTH * d;
    add_box(bars, {x - half, low, -d - half}, {x + half, STACK_EYE.y + HALF_HEIGHT * d, -d + half});
  }
}

}  // namespace

Scene make_near_plane() {
  Scene scene = night_scene("near-plane");
  const Materials m = add_materials(scene);
  add_ground(scene, m.ground, glm::vec2(-6.0F), glm::vec2(6.0F), 0.0F);
  add_kiosk(scene, m);
  add_garden(scene, m);
  scene.placement.box = Box{KIOSK_EYE - 0.8F, KIOSK_EYE + 0.8F};
  const glm::vec3 target = KIOSK_EYE + glm::vec3(0.0F, -0.9F, -2.5F);
  scene.cameras = {camera_at("desk", KIOSK_EYE, target, 1.0F),
                   camera_at("garden", {3.6F, 2.2F, 3.2F}, {0.0F, 1.5F, 0.0F}, 1.0F)};
  scene.flight = sway(KIOSK_EYE, glm::vec3(0.12F, 0.08F, 0.1F), target);
  return scene;
}

Scene make_wall() {
  Scene scene = night_scene("wall");
  const Materials m = add_materials(scene);
  add_wall(scene, m);
  add_yard(scene, m);
  scene.placement.box = Box{{-20.0F, -3.5F, -44.0F}, {20.0F, 9.0F, WALL_BACK_Z - YARD_GAP}};
  scene.placement.max_range = YARD_GAP;
  const glm::vec3 target(0.0F, 1.2F, WALL_FRONT_Z);
  scene.cameras = {camera_at("front", {0.4F, 1.7F, 0.0F}, target, 1.0F),
                   camera_at("yard", {21.0F, 5.0F, -46.0F}, {0.0F, 0.0F, WALL_BACK_Z}, 1.0F)};
  scene.flight = sway({0.0F, 1.7F, 0.6F}, {3.0F, 0.3F, 1.0F}, target);
  return scene;
}

Scene make_stack() {
  Scene scene = night_scene("stack");
  const Materials m = add_materials(scene);
  const std::array<std::uint32_t, 6> materials{m.wood, m.metal, m.marble, m.stone, m.brick, m.roof};
  for (int layer = 0; layer < LAYERS; ++layer) {
    Geometry bars;
    add_layer(bars, layer);
    add_once(scene, bars, materials[static_cast<std::size_t>(layer) % materials.size()]);
  }
  constexpr float END_M = FIRST_LAYER_M + LAYERS_APART_M * LAYERS;
  add_ground(scene, m.ground, {-90.0F, -END_M}, {90.0F, 6.0F}, 0.0F);
  Geometry end;
  add_box(end, {-90.0F, -1.0F, -END_M - 1.0F}, {90.0F, 90.0F, -END_M});
  add_once(scene, end, m.stone);
  scene.placement.box = Box{{-30.0F, 0.2F, -END_M + 1.0F}, {30.0F, 20.0F, -FIRST_LAYER_M - 1.0F}};
  const glm::vec3 target = STACK_EYE + glm::vec3(0.0F, 0.6F, -10.0F);
  scene.cameras = {camera_at("front", STACK_EYE, target, 1.0F),
                   camera_at("side", {-24.0F, 14.0F, 2.0F}, {4.0F, 3.0F, -30.0F}, 1.0F)};
  scene.flight = sway(STACK_EYE, {0.6F, 0.2F, 0.5F}, target);
  return scene;
}

}  // namespace lamp::app::procedural
