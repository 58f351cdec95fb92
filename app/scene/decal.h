// Decals as every source of scenes describes them: a box, projected along its z axis, and what is painted there.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <string_view>

namespace lamp::app {

/// Decals that a frame may have, and probes: more than anybody asks for.
inline constexpr std::uint32_t MAX_BOXES = 65536;

enum class DecalPattern : std::uint8_t { mosaic, painting, crack, moss, sign, plain };

struct Decal {
  glm::vec3 center{0.0F};                         ///< m, world space
  glm::quat orientation{1.0F, 0.0F, 0.0F, 0.0F};  ///< unit; its z axis points out of the surface, x along the picture
  glm::vec3 half_extents{0.5F, 0.5F, 0.1F};       ///< m, > 0
  DecalPattern pattern = DecalPattern::plain;
  glm::vec3 color_a{0.5F};  ///< linear Rec. 709, 0 .. 1
  glm::vec3 color_b{0.5F};
  std::uint32_t seed = 0;   ///< of what is random in the pattern
  float opacity = 1.0F;     ///< 0 .. 1
  float relief = 0.0F;      ///< m, height of the pattern as normals show it; 0: normals stay
  float full_angle = 0.6F;  ///< radians between the surface's normal and z: up to here all is painted
  float none_angle = 1.2F;  ///< from here on nothing; > full_angle
};

/// A rotation whose z axis is `normal` and whose y axis is as near to `up` as can be; both unit, and not parallel.
[[nodiscard]] inline glm::quat facing(const glm::vec3& normal, const glm::vec3& up) {
  const glm::vec3 x = glm::normalize(glm::cross(up, normal));
  return glm::normalize(glm::quat_cast(glm::mat3(x, glm::cross(normal, x), normal)));
}

}  // namespace lamp::app
