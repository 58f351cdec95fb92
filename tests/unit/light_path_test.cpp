// Paths of lights: sines in whole numbers are sines, and come round again.
// SPDX-License-Identifier: Apache-2.0
#include "scene/light_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace lamp::app {
namespace {

constexpr double TURN = 2.0 * std::numbers::pi;

LightPath some_path(double phase) {
  LightPath path{.middle = {10.0F, -3.0F, 0.5F}, .amplitude = {1.0F, 2.0F, 0.25F}, .waves = {1, 2, 3}};
  for (int axis = 0; axis < 3; ++axis) set_phase(path, axis, phase);
  return path;
}

TEST(LightPaths, AreSines) {
  for (const double phase : {0.0, 0.125, 0.3, 0.77, 0.999})
    for (std::uint32_t frame = 0; frame < 300; frame += 13) {
      const LightPath path = some_path(phase);
      const glm::vec3 found = position_at(path, path_time(frame, 300));
      for (int axis = 0; axis < 3; ++axis) {
        const double swing = std::sin(TURN * ((axis + 1) * frame / 300.0 + phase));
        const auto expected = static_cast<float>(path.middle[axis] + path.amplitude[axis] * swing);
        EXPECT_NEAR(found[axis], expected, 2e-7F * std::abs(expected)) << "frame " << frame << " phase " << phase;
      }
    }
}

TEST(LightPaths, NeverSwingFartherThanTheirAmplitude) {
  const LightPath path{.middle = {}, .amplitude = glm::vec3(1.0F), .waves = {1, 2, 3}};
  for (std::uint32_t i = 0; i <= 4000; ++i) {
    LightPath turned = path;
    for (int axis = 0; axis < 3; ++axis) set_phase(turned, axis, i / 4000.0);
    const glm::vec3 at = position_at(turned, path_time(i, 3001));
    for (int axis = 0; axis < 3; ++axis) ASSERT_LE(std::abs(at[axis]), 1.0F) << i;
  }
}

TEST(LightPaths, CloseAfterTheirFrames) {
  EXPECT_EQ(path_time(300, 300), path_time(0, 300));
  EXPECT_EQ(path_time(0, 300), PathTime());
  EXPECT_EQ(position_at(resting_at({1.0F, 2.0F, 3.0F}), path_time(7, 300)), glm::vec3(1.0F, 2.0F, 3.0F));
}

}  // namespace
}  // namespace lamp::app
