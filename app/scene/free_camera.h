// A camera that somebody flies: a place, a direction, and the lens of the camera that it left.
// Promise: the same numbers make the same matrix, bit for bit, wherever they were kept meanwhile.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace lamp::app {

struct FreeCamera {
  glm::dvec3 eye{0.0};  ///< m, world space
  double yaw = 0.0;     ///< radians, from -Z towards -X
  double pitch = 0.0;   ///< radians, upwards; within a right angle
  bool orthographic = false;
  float fov_y = 1.0F;  ///< as in Camera, and the others too
  float half_height = 1.0F;
  float near_m = 0.05F;
  float far_m = 0.0F;

  friend bool operator==(const FreeCamera&, const FreeCamera&) = default;
};

[[nodiscard]] Camera camera_of(const FreeCamera& free);

/// Where a camera of the scene stands, upright: a roll is lost.
[[nodiscard]] FreeCamera free_from(const Camera& camera);

/// Where it looks, and to its right: unit vectors.
[[nodiscard]] glm::dvec3 ahead(const FreeCamera& free);
[[nodiscard]] glm::dvec3 right(const FreeCamera& free);

}  // namespace lamp::app
