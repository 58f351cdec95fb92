// The atrium: materials, cameras and flight of a colonnaded court on two storeys.
// Based on: nothing.
// Promise: the first camera is the picture of the README.
// SPDX-License-Identifier: Apache-2.0
#include "scene/atrium.h"
#include "scene/builtin_scenes.h"
#include "scene/procedural_textures.h"

namespace lamp::app::procedural {
namespace {

/// A see-through version of a material, seen from both sides.
Material see_through(Material material, float alpha) {
  material.base_color.a = alpha;
  material.alpha_mode = AlphaMode::blend;
  material.double_sided = true;
  return material;
}

Material masked(Material material) {
  material.alpha_mode = AlphaMode::mask;
  material.double_sided = true;
  return material;
}

Material two_sided(Material material) {
  material.double_sided = true;
  return material;
}

void add_stone(Scene& scene, atrium::Materials& m) {
  m.wall = add_material(scene, use_surface(scene, stone_blocks({0.56F, 0.47F, 0.36F})));
  const Material marble_material = use_surface(scene, marble({0.78F, 0.72F, 0.64F}));
  m.column = add_material(scene, marble_material);
  const Material plaster_material = use_surface(scene, plaster({0.72F, 0.66F, 0.57F}));
  m.plaster = add_material(scene, plaster_material);
  m.trim = add_material(scene, tinted(plaster_material, "limestone", {0.92F, 0.86F, 0.78F}));
  m.terracotta = add_material(scene, tinted(plaster_material, "terracotta", {0.75F, 0.32F, 0.18F}));
  m.court_floor = add_material(
      scene, use_surface(scene, floor_tiles({0.62F, 0.56F, 0.48F}, {0.36F, 0.25F, 0.2F}, {0.06F, 0.09F, 0.1F})));
  Material aisle = use_surface(scene, floor_tiles({0.5F, 0.42F, 0.33F}, {0.46F, 0.39F, 0.3F}, {0.3F, 0.13F, 0.08F}));
  aisle.name = "aisle tiles";
  m.aisle_floor = add_material(scene, aisle);
  m.roof = add_material(scene, use_surface(scene, roof_tiles()));
}

void add_rest(Scene& scene, atrium::Materials& m) {
  m.wood = add_material(scene, use_surface(scene, planks({0.3F, 0.17F, 0.09F})));
  m.bronze = add_material(scene, use_surface(scene, worn_metal("bronze", {0.72F, 0.5F, 0.26F})));
  m.fretwork = add_material(scene, masked(use_surface(scene, fretwork())));
  m.leaves = add_material(scene, masked(use_surface(scene, leaf_mask({0.14F, 0.24F, 0.06F}))));
  const Material cloth_material = two_sided(use_surface(scene, cloth()));
  m.red_cloth = add_material(scene, tinted(cloth_material, "red cloth", {0.5F, 0.06F, 0.05F}));
  m.veil = add_material(scene, see_through(tinted(cloth_material, "veil", {0.85F, 0.85F, 0.9F}), 0.35F));
  m.glass = add_material(
      scene, see_through(plain_material({.name = "glass", .color = {0.5F, 0.65F, 0.7F}, .roughness = 0.06F}), 0.18F));
  m.water = add_material(
      scene, see_through(plain_material({.name = "water", .color = {0.05F, 0.16F, 0.18F}, .roughness = 0.05F}), 0.6F));
  m.lamp = add_material(
      scene, plain_material({.name = "lamp glass", .color = {0.8F, 0.7F, 0.5F}, .emissive = {4.0F, 2.4F, 1.1F}}));
  const std::vector<std::pair<std::string, BannerLook>> looks{
      {"red banner", {}},
      {"blue banner", {.field = {0.04F, 0.09F, 0.32F}, .band = {0.75F, 0.6F, 0.25F}}},
      {"green banner", {.field = {0.05F, 0.2F, 0.09F}, .band = {0.75F, 0.7F, 0.5F}}},
      {"ochre banner", {.field = {0.6F, 0.33F, 0.06F}, .band = {0.25F, 0.04F, 0.03F}}}};
  for (const auto& [name, look] : looks) {
    m.banners.push_back(add_material(scene, two_sided(use_surface(scene, banner(name, look, atrium::BANNER_M)))));
  }
}

/// Along the court, out through an arch, along an aisle, back in, and around the fountain.
Flight atrium_flight() {
  Flight flight;
  flight.keys = {
      {{-11.2F, 1.8F, 0.9F}, {-2.0F, 3.0F, -0.5F}}, {{-7.6F, 2.2F, 0.4F}, {2.0F, 3.2F, -1.0F}},
      {{-3.6F, 3.4F, 1.2F}, {6.0F, 3.6F, 0.2F}},    {{0.0F, 4.2F, 2.2F}, {9.0F, 4.0F, 1.0F}},
      {{4.2F, 4.6F, 1.2F}, {12.0F, 5.2F, -1.0F}},   {{8.2F, 5.0F, 0.2F}, {12.0F, 6.0F, -4.0F}},
      {{10.6F, 4.4F, -0.8F}, {6.0F, 5.5F, -4.0F}},  {{9.4F, 3.0F, -2.0F}, {3.0F, 2.6F, -4.0F}},
      {{6.2F, 2.2F, -0.9F}, {-2.0F, 2.4F, -3.0F}},  {{3.6F, 2.0F, -1.6F}, {-4.0F, 2.2F, -2.6F}},
      {{0.0F, 1.9F, -2.5F}, {-6.0F, 2.2F, -1.0F}},  {{-4.2F, 1.8F, -1.7F}, {-10.0F, 2.4F, 0.4F}},
      {{-8.4F, 1.8F, -1.4F}, {-12.0F, 2.4F, 2.4F}}, {{-10.8F, 1.8F, -0.6F}, {-8.0F, 2.6F, 4.0F}},
  };
  return flight;
}

}  // namespace

Scene make_atrium() {
  Scene scene;
  scene.name = "atrium";
  scene.sky = {0.03F, 0.048F, 0.12F};
  scene.ambient = {0.035F, 0.04F, 0.055F};
  atrium::Materials materials{};
  add_stone(scene, materials);
  add_rest(scene, materials);
  atrium::add_building(scene, materials);
  atrium::add_columns(scene, materials);
  atrium::add_decor(scene, materials);
  atrium::add_cloths(scene, materials);
  atrium::add_decals(scene);
  scene.cameras = {camera_at("court", {-12.0F, 1.95F, 1.15F}, {0.0F, 3.7F, -0.7F}, 1.1F),
                   camera_at("gallery", {-8.9F, 7.4F, 5.1F}, {3.0F, 4.4F, -4.4F}, 1.1F),
                   camera_at("close", {-8.3F, 1.6F, 5.6F}, {-3.0F, 1.9F, 1.5F}, 1.0F)};
  scene.flight = atrium_flight();
  return scene;
}

}  // namespace lamp::app::procedural
