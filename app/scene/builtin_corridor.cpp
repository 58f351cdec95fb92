// The corridor: materials, cameras and flight of a building most of which no camera sees at once.
// Based on: nothing.
// Promise: closed: no sky in sight from inside.
// SPDX-License-Identifier: Apache-2.0
#include "scene/builtin_scenes.h"
#include "scene/corridor.h"
#include "scene/procedural_textures.h"

namespace lamp::app::procedural {
namespace {

void add_surfaces(Scene& scene, corridor::Materials& m) {
  m.corridor_floor = add_material(
      scene, use_surface(scene, floor_tiles({0.5F, 0.48F, 0.44F}, {0.3F, 0.29F, 0.28F}, {0.08F, 0.1F, 0.12F})));
  m.tiles = add_material(scene, use_surface(scene, marble({0.55F, 0.6F, 0.6F})));
  const Material plaster_material = use_surface(scene, plaster({0.8F, 0.79F, 0.76F}));
  m.plaster = add_material(scene, plaster_material);
  m.white = add_material(scene, tinted(plaster_material, "ceiling", {0.9F, 0.9F, 0.9F}));
  m.warm_plaster = add_material(scene, tinted(plaster_material, "warm plaster", {0.9F, 0.72F, 0.52F}));
  m.clay = add_material(scene, tinted(plaster_material, "clay", {0.6F, 0.28F, 0.16F}));
  m.paper = add_material(scene, tinted(plaster_material, "paper", {0.95F, 0.93F, 0.88F}));
  m.brick = add_material(scene, use_surface(scene, bricks()));
  m.concrete = add_material(scene, use_surface(scene, concrete({0.45F, 0.44F, 0.42F})));
  const Material plank_material = use_surface(scene, planks({0.45F, 0.29F, 0.16F}));
  m.wood_floor = add_material(scene, plank_material);
  m.wood = add_material(scene, tinted(plank_material, "light wood", {1.0F, 0.95F, 0.85F}));
  m.dark_wood = add_material(scene, tinted(plank_material, "dark wood", {0.4F, 0.32F, 0.28F}));
  m.frame = add_material(scene, tinted(plank_material, "door frames", {0.6F, 0.5F, 0.42F}));
}

void add_rest(Scene& scene, corridor::Materials& m) {
  const Material cloth_material = use_surface(scene, cloth());
  m.carpet = add_material(scene, tinted(cloth_material, "carpet", {0.2F, 0.09F, 0.1F}));
  m.fabric = add_material(scene, tinted(cloth_material, "fabric", {0.16F, 0.26F, 0.36F}));
  m.leather =
      add_material(scene, plain_material({.name = "leather", .color = {0.05F, 0.04F, 0.04F}, .roughness = 0.4F}));
  m.metal = add_material(scene, use_surface(scene, worn_metal("steel", {0.58F, 0.59F, 0.62F})));
  m.copper = add_material(scene, use_surface(scene, worn_metal("copper", {0.85F, 0.48F, 0.3F})));
  Material grille = use_surface(scene, fretwork());
  grille.alpha_mode = AlphaMode::mask;
  grille.double_sided = true;
  m.grille = add_material(scene, grille);
  Material leaves = use_surface(scene, leaf_mask({0.1F, 0.22F, 0.06F}));
  leaves.alpha_mode = AlphaMode::mask;
  leaves.double_sided = true;
  m.leaves = add_material(scene, leaves);
  Material glass = plain_material({.name = "glass", .color = {0.5F, 0.65F, 0.65F}, .roughness = 0.06F});
  glass.base_color.a = 0.2F;
  glass.alpha_mode = AlphaMode::blend;
  glass.double_sided = true;
  m.glass = add_material(scene, glass);
  m.lamp =
      add_material(scene, plain_material({.name = "lamp", .color = glm::vec3(0.8F), .emissive = {3.0F, 2.7F, 2.1F}}));
  const std::array<BannerLook, 3> looks{{{.field = {0.1F, 0.2F, 0.3F}, .band = {0.7F, 0.5F, 0.2F}},
                                         {.field = {0.5F, 0.4F, 0.25F}, .band = {0.2F, 0.06F, 0.05F}},
                                         {.field = {0.08F, 0.16F, 0.08F}, .band = {0.6F, 0.62F, 0.5F}}}};
  for (std::size_t i = 0; i < looks.size(); ++i) {
    m.pictures[i] = add_material(scene, use_surface(scene, banner("picture", looks[i], {0.7F, 0.9F})));
  }
}

/// Along the corridor, into a room and out again, around the hall, and back.
Flight corridor_flight() {
  const float door = corridor::door_x(2, 1);
  Flight flight;
  flight.keys = {
      {{1.2F, 1.65F, 0.2F}, {8.0F, 1.5F, -0.1F}},
      {{4.6F, 1.65F, 0.2F}, {12.0F, 1.5F, -0.1F}},
      {{8.8F, 1.6F, -0.15F}, {14.0F, 1.5F, 0.2F}},
      {{12.8F, 1.6F, -0.2F}, {door, 1.4F, 1.4F}},
      {{door - 1.2F, 1.55F, -0.1F}, {door + 0.2F, 1.3F, 3.0F}},
      {{door - 0.1F, 1.5F, 0.9F}, {door - 1.0F, 1.2F, 5.0F}},
      {{door, 1.5F, 2.0F}, {door - 3.0F, 1.1F, 5.0F}},
      {{door - 0.3F, 1.5F, 2.9F}, {door - 4.0F, 1.2F, 3.0F}},
      {{door - 0.05F, 1.5F, 2.2F}, {door - 2.0F, 1.3F, -1.0F}},
      {{door, 1.5F, 1.0F}, {door + 2.0F, 1.4F, -1.0F}},
      {{door + 1.2F, 1.6F, 0.15F}, {24.0F, 1.5F, 0.0F}},
      {{21.0F, 1.6F, 0.2F}, {28.0F, 1.5F, 0.0F}},
      {{25.0F, 1.6F, 0.1F}, {32.0F, 1.5F, 0.2F}},
      {{29.0F, 1.6F, 0.0F}, {35.0F, 1.4F, 1.6F}},
      {{32.4F, 1.6F, -0.6F}, {37.0F, 1.4F, 3.0F}},
      {{35.2F, 1.6F, -0.5F}, {36.0F, 1.4F, 5.0F}},
      {{35.6F, 1.6F, 1.0F}, {30.0F, 1.4F, 3.0F}},
      {{33.0F, 1.6F, 0.8F}, {26.0F, 1.5F, 0.0F}},
      {{29.0F, 1.65F, 0.1F}, {22.0F, 1.5F, 0.0F}},
      {{25.0F, 1.65F, 0.2F}, {18.0F, 1.5F, 0.0F}},
      {{21.0F, 1.65F, 0.25F}, {14.0F, 1.5F, -0.2F}},
      {{17.0F, 1.65F, 0.0F}, {10.0F, 1.5F, -0.2F}},
      {{13.0F, 1.65F, -0.2F}, {6.0F, 1.5F, -0.1F}},
      {{9.0F, 1.65F, -0.15F}, {2.0F, 1.5F, 0.2F}},
      {{5.0F, 1.65F, 0.3F}, {0.0F, 1.5F, 0.4F}},
      {{2.0F, 1.65F, 0.6F}, {0.6F, 1.5F, -2.0F}},
  };
  flight.fov_y = 1.1F;
  return flight;
}

}  // namespace

Scene make_corridor() {
  Scene scene;
  scene.name = "corridor";
  scene.sky = {0.008F, 0.012F, 0.03F};
  scene.ambient = {0.03F, 0.032F, 0.04F};
  corridor::Materials materials{};
  add_surfaces(scene, materials);
  add_rest(scene, materials);
  corridor::add_building(scene, materials);
  corridor::add_furniture(scene, materials);
  scene.cameras = {camera_at("corridor", {0.5F, 1.62F, 0.45F}, {12.0F, 1.35F, -0.35F}, 1.0F),
                   camera_at("room", {9.4F, 1.6F, 1.75F}, {9.6F, 1.0F, 6.0F}, 1.1F)};
  scene.flight = corridor_flight();
  return scene;
}

}  // namespace lamp::app::procedural
