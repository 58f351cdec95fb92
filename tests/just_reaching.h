// Lights that only just reach a point: four times as far within them as the oracle is unsure.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <glm/glm.hpp>

#include "lamplight/light.h"

namespace lamp::test {

inline constexpr double JUST_WITHIN = 1.0 - 4e-5;

/// The end of its range. `towards`: from the light to the point, unit; so is `outside` below.
inline Light point_just_reaching(const glm::dvec3& point, const glm::dvec3& towards, double distance) {
  return {.position = glm::vec3(point - distance * towards), .range = static_cast<float>(distance / JUST_WITHIN)};
}

/// The side of its cone, whose axis is on the side of the point that `outside`, at right angles to `towards`, says.
inline Light spot_just_reaching(const glm::dvec3& point, const glm::dvec3& towards, double distance,
                                const glm::dvec3& outside, double angle) {
  Light light = point_just_reaching(point, towards, distance);
  light.type = LightType::spot;
  light.range *= 1.5F;
  light.outer_angle = static_cast<float>(angle);
  light.direction = glm::vec3(std::cos(angle * JUST_WITHIN) * towards + std::sin(angle * JUST_WITHIN) * outside);
  return light;
}

}  // namespace lamp::test
