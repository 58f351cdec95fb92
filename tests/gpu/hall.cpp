// Builds the hall.
// SPDX-License-Identifier: Apache-2.0
#include "gpu/hall.h"

#include <cmath>

namespace lamp::app {

void add_quad(Scene& scene, float height, float half, bool front_up, std::uint32_t material) {
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  const glm::vec3 normal(0.0F, front_up ? 1.0F : -1.0F, 0.0F);
  for (const glm::vec2 at : {glm::vec2(-1, -1), glm::vec2(-1, 1), glm::vec2(1, 1), glm::vec2(1, -1)})
    scene.vertices.push_back({.position = {half * at.x, height, half * at.y}, .normal = normal});
  scene.meshes.push_back({.first_index = static_cast<std::uint32_t>(scene.indices.size()),
                          .index_count = 6,
                          .vertex_offset = first,
                          .material = material});
  for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) scene.indices.push_back(front_up ? i : (4U - i) % 4U);
  scene.instances.push_back({.mesh = static_cast<std::uint32_t>(scene.meshes.size()) - 1});
}

Scene hall(float half_ceiling) {
  Scene scene{.name = "hall"};
  scene.materials = {Material{.base_color = {1.0F, 1.0F, 1.0F, 1.0F}, .metallic = 1.0F, .roughness = 0.05F},
                     Material{.base_color = {0.0F, 0.0F, 0.0F, 1.0F}, .emissive = {0.0F, 2.0F, 0.0F}}};
  add_quad(scene, 0.0F, 50.0F, true, 0);
  add_quad(scene, 3.0F, half_ceiling, false, 1);
  scene.sky = {0.5F, 0.0F, 0.0F};
  Camera camera{.name = "down", .far_m = 0.0F};
  camera.world_from_camera = glm::mat4(1.0F);
  const float tilt = 0.8F;  // radians below the horizon
  camera.world_from_camera[1] = {0.0F, std::cos(tilt), -std::sin(tilt), 0.0F};
  camera.world_from_camera[2] = {0.0F, std::sin(tilt), std::cos(tilt), 0.0F};
  camera.world_from_camera[3] = {0.0F, 1.0F, 0.0F, 1.0F};
  camera.fov_y = 0.5F;
  scene.cameras = {camera};
  return scene;
}

}  // namespace lamp::app
