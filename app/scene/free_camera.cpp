// Angles to axes and back.
// SPDX-License-Identifier: Apache-2.0
#include "scene/free_camera.h"

#include <algorithm>
#include <cmath>

namespace lamp::app {

glm::dvec3 ahead(const FreeCamera& free) {
  return {-std::sin(free.yaw) * std::cos(free.pitch), std::sin(free.pitch), -std::cos(free.yaw) * std::cos(free.pitch)};
}

glm::dvec3 right(const FreeCamera& free) { return {std::cos(free.yaw), 0.0, -std::sin(free.yaw)}; }

Camera camera_of(const FreeCamera& free) {
  const glm::dvec3 back = -ahead(free);
  const glm::dvec3 side = right(free);
  glm::dmat4 world_from_camera(1.0);
  world_from_camera[0] = glm::dvec4(side, 0.0);
  world_from_camera[1] = glm::dvec4(glm::cross(back, side), 0.0);
  world_from_camera[2] = glm::dvec4(back, 0.0);
  world_from_camera[3] = glm::dvec4(free.eye, 1.0);
  return {.name = "free",
          .world_from_camera = glm::mat4(world_from_camera),
          .orthographic = free.orthographic,
          .fov_y = free.fov_y,
          .half_height = free.half_height,
          .near_m = free.near_m,
          .far_m = free.far_m};
}

FreeCamera free_from(const Camera& camera) {
  const glm::dvec3 look = -glm::normalize(glm::dvec3(camera.world_from_camera[2]));
  return {.eye = glm::dvec3(camera.world_from_camera[3]),
          .yaw = std::atan2(-look.x, -look.z),
          .pitch = std::asin(std::clamp(look.y, -1.0, 1.0)),
          .orthographic = camera.orthographic,
          .fov_y = camera.fov_y,
          .half_height = camera.half_height,
          .near_m = camera.near_m,
          .far_m = camera.far_m};
}

}  // namespace lamp::app
