// Random points and lights in the world, for look-ups by position.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

#include "lamplight/light.h"
#include "scene/procedural_random.h"

namespace lamp::test {

using Points = std::vector<glm::vec3>;

inline Points points_in(std::uint64_t seed, std::size_t count, const glm::vec3& low, const glm::vec3& high) {
  app::procedural::Random random(seed);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const float x = random.between(low.x, high.x);
    const float y = random.between(low.y, high.y);
    points.emplace_back(x, y, random.between(low.z, high.z));
  }
  return points;
}

/// Point lights and spots, in a cube around a centre.
inline std::vector<shared::Light> lights_around(const glm::vec3& center, float half, float min_range, float max_range,
                                                std::size_t count) {
  app::procedural::Random random(3);
  std::vector<Light> lights;
  for (const glm::vec3& position : points_in(4, count, center - half, center + half)) {
    Light light{.position = position, .range = random.between(min_range, max_range)};
    light.type = random.chance(0.5F) ? LightType::spot : LightType::point;
    light.direction = {random.between(-1.0F, 1.0F), random.between(-1.0F, 1.0F), random.between(0.1F, 1.0F)};
    light.outer_angle = random.between(0.0F, 1.57F);
    lights.push_back(light);
  }
  return pack(lights);
}

struct LightsAndPoints {
  std::vector<Light> lights;
  Points points;
};

/// Lights of ranges from a millionth of a metre to more than there is, with points within and beyond; the last four
/// reach nothing, or everything.
inline LightsAndPoints lights_of_every_range() {
  LightsAndPoints made;
  app::procedural::Random random(5);
  for (int exponent = -20; exponent <= 59; ++exponent) {
    const float range = std::ldexp(random.between(1.0F, 2.0F), exponent);
    made.lights.push_back({.position = {range, 0.0F, 0.0F}, .range = range});
    made.points.emplace_back(range * 0.25F, 0.0F, 0.0F);
    made.points.emplace_back(range * 1.5F, -0.5F * range, 0.0F);
  }
  for (const float range : {0.0F, 1e18F, 3e38F, std::numeric_limits<float>::infinity()})
    made.lights.push_back({.position{}, .range = range});
  return made;
}

}  // namespace lamp::test
