// The city: materials, cameras and flight.
// Based on: nothing.
// Promise: from the street, depths run from less than half a metre to more than a kilometre.
// SPDX-License-Identifier: Apache-2.0
#include "scene/blocks.h"
#include "scene/builtin_scenes.h"
#include "scene/procedural_textures.h"

namespace lamp::app::procedural {
namespace {

std::uint32_t add_plain(Scene& scene, const Plain& plain) { return add_material(scene, plain_material(plain)); }

/// The first two are for towers.
std::vector<std::uint32_t> add_facades(Scene& scene) {
  const std::vector<FacadeLook> looks{
      {.name = "glass tower",
       .wall = {0.16F, 0.18F, 0.2F},
       .window_min = {0.06F, 0.1F},
       .window_max = {0.94F, 0.88F},
       .lit = 0.22F,
       .wall_roughness = 0.4F,
       .seed = 1},
      {.name = "concrete tower",
       .wall = {0.42F, 0.4F, 0.37F},
       .window_min = {0.12F, 0.22F},
       .window_max = {0.88F, 0.74F},
       .lit = 0.26F,
       .seed = 2},
      {.name = "brick house", .wall = {0.36F, 0.16F, 0.1F}, .lit = 0.3F, .bricks = true, .seed = 3},
      {.name = "plaster house",
       .wall = {0.58F, 0.5F, 0.38F},
       .window_min = {0.3F, 0.18F},
       .window_max = {0.7F, 0.8F},
       .lit = 0.28F,
       .seed = 4},
      {.name = "pale brick house",
       .wall = {0.5F, 0.44F, 0.34F},
       .window_min = {0.18F, 0.24F},
       .window_max = {0.82F, 0.74F},
       .lit = 0.22F,
       .bricks = true,
       .seed = 5}};
  std::vector<std::uint32_t> materials;
  for (const FacadeLook& look : looks) {
    Material material = use_surface(scene, facade(look));
    material.emissive = glm::vec3(0.5F);
    materials.push_back(add_material(scene, material));
  }
  return materials;
}

blocks::Materials add_materials(Scene& scene) {
  blocks::Materials m{};
  m.facades = add_facades(scene);
  Material shops = use_surface(scene, shop_fronts());
  shops.emissive = glm::vec3(0.8F);
  m.shops = add_material(scene, shops);
  const Material concrete_material = use_surface(scene, concrete({0.4F, 0.39F, 0.37F}));
  m.pavement = add_material(scene, concrete_material);
  m.ledge = add_material(scene, tinted(concrete_material, "ledges", {0.85F, 0.82F, 0.78F}));
  const Material asphalt_material = use_surface(scene, asphalt());
  m.asphalt = add_material(scene, asphalt_material);
  m.roof = add_material(scene, tinted(asphalt_material, "roofs", {1.0F, 0.95F, 0.9F}));
  m.road = add_material(scene, use_surface(scene, road()));
  m.crossing = add_material(scene, use_surface(scene, crossing()));
  m.metal = add_material(scene, use_surface(scene, worn_metal("painted metal", {0.25F, 0.28F, 0.3F})));
  m.bark = add_material(scene, use_surface(scene, planks({0.22F, 0.14F, 0.09F})));
  Material leaves = use_surface(scene, leaf_mask({0.12F, 0.22F, 0.05F}));
  leaves.alpha_mode = AlphaMode::mask;
  leaves.double_sided = true;
  m.leaves = add_material(scene, leaves);
  m.grass = add_material(scene, use_surface(scene, forest_floor()));
  m.rubber = add_plain(scene, {.name = "rubber", .color = {0.02F, 0.02F, 0.02F}, .roughness = 0.9F});
  m.glass = add_plain(scene, {.name = "car glass", .color = {0.03F, 0.035F, 0.04F}, .roughness = 0.08F});
  m.lamp = add_plain(scene, {.name = "lamp", .color = {0.8F, 0.8F, 0.7F}, .emissive = {4.0F, 3.0F, 1.8F}});
  m.red_light = add_plain(scene, {.name = "red light", .color = {0.5F, 0.02F, 0.02F}, .emissive = {2.2F, 0.1F, 0.07F}});
  m.green_light =
      add_plain(scene, {.name = "green light", .color = {0.02F, 0.5F, 0.1F}, .emissive = {0.1F, 2.0F, 0.5F}});
  for (const glm::vec3 paint : {glm::vec3(0.45F, 0.03F, 0.03F), glm::vec3(0.04F, 0.1F, 0.32F), glm::vec3(0.6F),
                                glm::vec3(0.03F, 0.03F, 0.035F), glm::vec3(0.62F, 0.42F, 0.05F)}) {
    m.paints.push_back(add_plain(scene, {.name = "car paint", .color = paint, .roughness = 0.25F, .metallic = 0.2F}));
  }
  return m;
}

/// Down the middle street, up at its crossing with the middle avenue, a wide turn above the roofs, and back down.
Flight city_flight() {
  Flight flight;
  flight.keys = {
      {{-520, 4, 0}, {-400, 10, 0}},       {{-420, 6, 0}, {-300, 14, 0}},       {{-320, 10, 0}, {-200, 20, 0}},
      {{-220, 16, 0}, {-100, 30, 0}},      {{-120, 24, 0}, {-10, 40, 10}},      {{-30, 34, 0}, {10, 50, 80}},
      {{-1, 42, 18}, {10, 55, 140}},       {{0, 56, 100}, {10, 60, 240}},       {{0, 90, 200}, {-20, 80, 320}},
      {{-30, 150, 300}, {-180, 100, 340}}, {{-140, 220, 360}, {-260, 90, 220}}, {{-290, 250, 330}, {-240, 40, 120}},
      {{-430, 240, 250}, {-220, 20, 20}},  {{-540, 200, 150}, {-240, 20, -10}}, {{-620, 120, 60}, {-320, 20, 0}},
      {{-610, 40, 10}, {-400, 12, 0}},
  };
  flight.fov_y = 1.1F;
  return flight;
}

}  // namespace

Scene make_blocks() {
  Scene scene;
  scene.name = "blocks";
  scene.sky = {0.02F, 0.03F, 0.075F};
  scene.ambient = {0.03F, 0.034F, 0.05F};
  const blocks::Materials materials = add_materials(scene);
  blocks::add_buildings(scene, materials);
  blocks::add_streets(scene, materials);
  blocks::add_street_furniture(scene, materials);
  scene.cameras = {camera_at("street", {-537.6F, 1.75F, 7.9F}, {-480.0F, 4.6F, 2.0F}, 1.05F),
                   camera_at("above", {-330.0F, 250.0F, 330.0F}, {-40.0F, 20.0F, 20.0F}, 0.95F)};
  scene.flight = city_flight();
  return scene;
}

}  // namespace lamp::app::procedural
