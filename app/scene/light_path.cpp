// Sines of sums by the addition theorem, in whole numbers.
// Based on: fixed-point arithmetic with 30 bits behind the point.
// SPDX-License-Identifier: Apache-2.0
#include "scene/light_path.h"

#include <cmath>
#include <numbers>

namespace lamp::app {
namespace {

constexpr double TURN = 2.0 * std::numbers::pi;

std::int32_t fixed(double share) { return static_cast<std::int32_t>(std::lround(share * PATH_ONE)); }

}  // namespace

PathTime path_time(std::uint32_t frame, std::uint32_t frames) {
  PathTime time;
  for (int i = 0; i < 3; ++i) {
    const double angle = TURN * (i + 1) * static_cast<double>(frame % frames) / frames;
    time.sine[i] = fixed(std::sin(angle));
    time.cosine[i] = fixed(std::cos(angle));
  }
  return time;
}

void set_phase(LightPath& path, int axis, double turns) {
  path.sine[axis] = fixed(std::sin(TURN * turns));
  path.cosine[axis] = fixed(std::cos(TURN * turns));
}

LightPath resting_at(const glm::vec3& position) { return {.middle = position}; }

/// Products and sums of two 32-bit numbers are exact, or rounded innocuously, in 64 bits: what is rounded to 32 bits
/// after each of them are the results that 32-bit arithmetic has, and no compiler joins them into one.
glm::vec3 position_at(const LightPath& path, const PathTime& time) {
  glm::vec3 position;
  for (int axis = 0; axis < 3; ++axis) {
    const int waves = static_cast<int>(path.waves[axis]) - 1;
    const std::int64_t sum = std::int64_t{path.sine[axis]} * time.cosine[waves] +
                             std::int64_t{path.cosine[axis]} * time.sine[waves] + PATH_ONE / 2;
    const float swing = static_cast<float>(static_cast<std::int32_t>(sum >> 30)) / static_cast<float>(PATH_ONE);
    const auto away = static_cast<float>(double{path.amplitude[axis]} * swing);
    position[axis] = static_cast<float>(double{path.middle[axis]} + away);
  }
  return position;
}

}  // namespace lamp::app
