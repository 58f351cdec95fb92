// The known-answer scene: one grey diffuse plane under one white point light.
// Based on: nothing; below the light, the plane's irradiance is 100 cd / (2 m)² = 25 lux (times the range window).
// Promise: its numbers never change; tests compute the picture from them.
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include "scene/builtin_scenes.h"
#include "scene/mesh_builder.h"
#include "scene/procedural_textures.h"

namespace lamp::app::procedural {

Scene make_plane() {
  constexpr float HALF = 10.0F;
  Scene scene;
  scene.name = "plane";
  const std::uint32_t grey = add_material(scene, plain_material({.name = "grey", .roughness = 1.0F}));
  Geometry plane;
  add_quad(plane, {-HALF, 0, HALF}, {HALF, 0, HALF}, {HALF, 0, -HALF}, {-HALF, 0, -HALF});
  add_once(scene, plane, grey);
  Light light;
  light.position = {0.0F, 2.0F, 0.0F};
  light.range = 1000.0F;
  light.intensity = 100.0F;
  scene.lights.push_back(light);
  scene.cameras = {camera_at("front", {0, 4, 6}, {0, 0, 0}, 1.0F)};
  Flight flight;
  for (int i = 0; i < 8; ++i) {  // once around at the camera's distance
    const float turn = static_cast<float>(i) / 8.0F * 2.0F * std::numbers::pi_v<float>;
    flight.keys.push_back({.eye = {6.0F * std::sin(turn), 4.0F, 6.0F * std::cos(turn)}, .target = glm::vec3(0.0F)});
  }
  scene.flight = flight;
  return scene;
}

}  // namespace lamp::app::procedural
