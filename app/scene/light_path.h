// The closed path of a generated light: where it is at a time, the same bits here and in move_lights.comp.
// Promise: sines are whole numbers, so that no rounding but that of one product and one sum decides where a light is.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace lamp::app {

/// Along each axis middle + amplitude * sin(waves * time + phase), the time in turns.
struct LightPath {
  glm::vec3 middle{0.0F};     ///< m
  glm::vec3 amplitude{0.0F};  ///< m
  glm::uvec3 waves{1};        ///< a path, 1 .. 3
  glm::ivec3 sine{0};         ///< of the phase; PATH_ONE is 1
  glm::ivec3 cosine{0};
};
inline constexpr std::int32_t PATH_ONE = 1 << 30;
inline constexpr std::uint32_t MOST_PATH_WAVES = 3;

/// Of a time that is the same for all lights, for 1, 2 and 3 waves.
struct PathTime {
  glm::ivec3 sine{0};
  glm::ivec3 cosine{PATH_ONE};

  friend bool operator==(const PathTime&, const PathTime&) = default;
};
/// A path closes after `frames`, > 0.
[[nodiscard]] PathTime path_time(std::uint32_t frame, std::uint32_t frames);

/// The phase of one axis, in turns.
void set_phase(LightPath& path, int axis, double turns);
/// A path that never leaves a place.
[[nodiscard]] LightPath resting_at(const glm::vec3& position);

[[nodiscard]] glm::vec3 position_at(const LightPath& path, const PathTime& time);

}  // namespace lamp::app
