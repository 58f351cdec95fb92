// A camera and a flight for scenes that come without: inside what is as large as a building, around what is smaller.
// SPDX-License-Identifier: Apache-2.0
#include "scene/default_view.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>

namespace lamp::app {
namespace {

constexpr float FOV_Y = 1.0F;
constexpr std::size_t KEYS = 8;

/// Lengths in metres. `along` is the longer horizontal axis.
struct Shape {
  glm::vec3 center{0.0F};
  glm::vec3 half{0.5F};
  glm::vec3 along{1.0F, 0.0F, 0.0F};
  glm::vec3 beside{0.0F, 0.0F, 1.0F};
  float half_along = 0.5F;
  float half_beside = 0.5F;
  bool inside = false;  ///< large enough to stand in
  float radius = 1.0F;
};

Shape shape_of(const Box& bounds) {
  Shape shape;
  shape.center = bounds.min * 0.5F + bounds.max * 0.5F;
  shape.half = bounds.max * 0.5F - bounds.min * 0.5F;
  if (shape.half.z > shape.half.x) std::swap(shape.along, shape.beside);
  shape.half_along = std::max(shape.half.x, shape.half.z);
  shape.half_beside = std::min(shape.half.x, shape.half.z);
  shape.inside = shape.half_along > 4.0F && shape.half_beside > 2.0F && shape.half.y > 1.25F;
  shape.radius = glm::length(shape.half);
  // What is smaller is a point, but for what was rounded on its way here.
  if (shape.radius < std::max(1e-9F, 1e-6F * glm::length(shape.center))) shape.radius = std::max(shape.radius, 1e-3F);
  return shape;
}

/// 1, but less in a scene that is too small to stand in.
float scale_of(const Shape& shape) { return std::min(shape.radius / 4.0F, 1.0F); }

/// A person's eyes, or a fifth of the height where that is more: floors often lie above the lowest point.
float eye_height(const Shape& shape) { return shape.center.y - shape.half.y + std::max(1.7F, 0.4F * shape.half.y); }

/// From the middle to an eye that looks at the whole from outside.
glm::vec3 outside_direction(float angle) { return glm::normalize(glm::vec3(std::cos(angle), 0.5F, std::sin(angle))); }

/// Far enough away for the bounding sphere to fit into the picture.
glm::vec3 outside_eye(const Shape& shape, float angle) {
  return shape.center + outside_direction(angle) * (shape.radius / std::sin(FOV_Y * 0.5F));
}

/// The pose at `eye` that looks along the unit vector `ahead`, which is not vertical.
glm::mat4 pose(glm::vec3 eye, glm::vec3 ahead) {
  const glm::vec3 right = glm::normalize(glm::cross(ahead, glm::vec3(0, 1, 0)));
  return {glm::vec4(right, 0.0F), glm::vec4(glm::cross(right, ahead), 0.0F), glm::vec4(-ahead, 0.0F),
          glm::vec4(eye, 1.0F)};
}

}  // namespace

Camera default_camera(const Box& bounds) {
  const Shape shape = shape_of(bounds);
  Camera camera;
  camera.name = "default";
  if (shape.inside) {
    glm::vec3 eye = shape.center - shape.along * (0.55F * shape.half_along);
    eye.y = eye_height(shape);
    camera.world_from_camera = pose(eye, shape.along);
  } else {
    const float angle = glm::quarter_pi<float>();
    camera.world_from_camera = pose(outside_eye(shape, angle), -outside_direction(angle));
  }
  camera.fov_y = FOV_Y;
  camera.near_m = shape.inside ? 0.05F : 0.01F * shape.radius;
  return camera;
}

Flight default_flight(const Box& bounds) {
  const Shape shape = shape_of(bounds);
  const auto eye_at = [&shape](std::size_t key) {
    const float angle = glm::two_pi<float>() * static_cast<float>(key) / static_cast<float>(KEYS);
    if (!shape.inside) return outside_eye(shape, angle);
    // A narrow loop: columns, galleries and furniture stand along the sides.
    glm::vec3 eye = shape.center + shape.along * (0.6F * shape.half_along * -std::cos(angle)) +
                    shape.beside * (0.1F * shape.half_beside * std::sin(angle));
    eye.y = eye_height(shape);
    return eye;
  };
  Flight flight;
  flight.fov_y = FOV_Y;
  flight.near_m *= scale_of(shape);
  for (std::size_t key = 0; key < KEYS; ++key) {
    flight.keys.push_back({eye_at(key), shape.inside ? eye_at(key + 1) : shape.center});
  }
  return flight;
}

Flight flight_at(const Camera& camera, const Box& bounds) {
  const float scale = scale_of(shape_of(bounds));
  Flight flight;
  flight.fov_y = camera.fov_y;
  flight.near_m *= scale;
  const glm::vec3 eye(camera.world_from_camera[3]);
  const glm::vec3 back(camera.world_from_camera[2]);
  const float start = std::atan2(-back.z, -back.x);
  for (std::size_t key = 0; key < KEYS; ++key) {
    const float angle = start + glm::two_pi<float>() * static_cast<float>(key) / static_cast<float>(KEYS);
    const glm::vec3 ahead(std::cos(angle), 0.0F, std::sin(angle));
    flight.keys.push_back({eye + ahead * (0.3F * scale), eye + ahead * (10.0F * scale)});
  }
  return flight;
}

}  // namespace lamp::app
