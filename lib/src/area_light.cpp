// The lights around area lights, in double precision, rounded outward.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/area_light.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <numbers>

namespace lamp {
namespace {

constexpr double ROUNDING = 1.2e-7;  ///< of 32 bits, as a share: two units in the last place
constexpr float RIGHT_ANGLE = std::numbers::pi_v<float> / 2.0F;

/// Around a surface that lies within `radius` of `center`.
Light around(const glm::dvec3& center, double radius, float range) {
  Light light;
  light.position = glm::vec3(center);
  // A range of 0 reaches nothing, however large the surface. What is wrong stays so: a NaN where the surface is.
  light.range = range;
  if (!(range > 0.0F)) return light;
  const double moved = glm::length(glm::dvec3(light.position) - center);
  const double reach = (double{range} + radius + moved) * (1.0 + ROUNDING);
  light.range = radius >= 0.0 ? static_cast<float>(reach) : std::numeric_limits<float>::quiet_NaN();
  return light;
}

/// Half of it. The spot begins a little behind the surface: directions and positions of 32 bits may lean that much.
Light in_front(const glm::dvec3& center, const glm::dvec3& normal, double radius, float range) {
  Light light = around(center, radius, range);
  light.type = LightType::spot;
  light.direction = glm::vec3(normal);
  light.outer_angle = RIGHT_ANGLE;
  if (!(light.range > 0.0F) || light.range >= shared::INFINITE_RADIUS) return light;
  const double behind = 8.0 * ROUNDING * (double{light.range} + glm::length(center));
  const double length = glm::length(normal);
  if (!(length > 0.0)) return light;
  light.direction = glm::vec3(normal / length);
  const Light moved = around(center - behind / length * normal, radius + behind, range);
  light.position = moved.position;
  light.range = moved.range;
  return light;
}

}  // namespace

Light bounding_light(const RectangleLight& shape, float range) {
  const glm::dvec3 x(shape.half_x);
  const glm::dvec3 y(shape.half_y);
  const double radius = std::max(glm::length(x + y), glm::length(x - y));
  if (shape.faces == Faces::both) return around(shape.center, radius, range);
  return in_front(shape.center, glm::cross(x, y), radius, range);
}

Light bounding_light(const DiscLight& shape, float range) {
  if (shape.faces == Faces::both) return around(shape.center, shape.radius, range);
  return in_front(shape.center, shape.normal, shape.radius, range);
}

Light bounding_light(const TubeLight& shape, float range) {
  const glm::dvec3 from(shape.from);
  const glm::dvec3 to(shape.to);
  // Its ends reach as far: what is wrong with the radius must not be lost in their distance.
  const double radius = shape.radius >= 0.0F ? glm::length(to - from) / 2.0 + double{shape.radius} : -1.0;
  return around((from + to) / 2.0, radius, range);
}

}  // namespace lamp
