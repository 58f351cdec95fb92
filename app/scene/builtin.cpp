// The table of built-in scenes.
// Based on: nothing.
// Promise: the first row is the command line's default; names never change once published.
// SPDX-License-Identifier: Apache-2.0
#include "scene/builtin.h"

#include <array>

#include "scene/builtin_scenes.h"

namespace lamp::app {

std::span<const BuiltinScene> builtin_scenes() {
  static constexpr std::array<BuiltinScene, 11> TABLE{{
      {"atrium", "a colonnaded court on two storeys: near columns, far walls, banners, glass", procedural::make_atrium},
      {"blocks", "a city by night: hundreds of buildings, depths from 0.3 m to over a kilometre",
       procedural::make_blocks},
      {"posts", "a birch wood with reeds: thousands of thin posts and leaves, many depths in every tile",
       procedural::make_posts},
      {"corridor", "rooms along a corridor: most of the scene, and most of its lights, are hidden",
       procedural::make_corridor},
      {"plane", "known answer: one grey plane under one point light", procedural::make_plane},
      {"one-tile", "adversarial: a hall, all lights in a swarm at its far end that covers a few pixels",
       procedural::make_one_tile, true},
      {"near-plane", "adversarial: a kiosk, all lights around the eye, many across the near plane",
       procedural::make_near_plane, true},
      {"huge-and-tiny", "adversarial: a hall, ranges over four orders of magnitude", procedural::make_huge_and_tiny,
       true},
      {"needles", "adversarial: a hall, spots are long and of 0.5 degrees half-angle", procedural::make_needles, true},
      {"wall", "adversarial: all lights behind a wall that fills the picture", procedural::make_wall, true},
      {"stack", "adversarial: 32 layers of bars behind each other, a tile sees most of them", procedural::make_stack,
       true},
  }};
  return TABLE;
}

Camera procedural::camera_at(const std::string& name, const glm::vec3& eye, const glm::vec3& target, float fov_y) {
  Camera camera;
  camera.name = name;
  const glm::dvec3 back = glm::normalize(glm::dvec3(eye) - glm::dvec3(target));
  const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), back));
  const glm::dvec3 up = glm::cross(back, right);
  camera.world_from_camera = {glm::vec4(right, 0), glm::vec4(up, 0), glm::vec4(back, 0), glm::vec4(eye, 1)};
  camera.fov_y = fov_y;
  return camera;
}

}  // namespace lamp::app
