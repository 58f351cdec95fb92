// What the shadow atlas draws of lights that stand still: after frames without a budget, and near what has no place.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <vector>

#include "lamplight/light.h"
#include "lamplight/shadow_atlas.h"

namespace lamp {
namespace {

/// Points and spots in turn, on a floor, each of another size than its neighbours.
std::vector<shared::Light> lights_on_a_floor(std::size_t count) {
  std::vector<Light> lights;
  for (std::size_t i = 0; i < count; ++i)
    lights.push_back({.type = i % 2 == 0 ? LightType::point : LightType::spot,
                      .position = {static_cast<float>(i % 16), 0.0F, static_cast<float>(i) / 16.0F},
                      .range = 0.5F + 0.25F * static_cast<float>(i % 7),
                      .direction = {0.0F, -1.0F, 0.0F},
                      .outer_angle = 0.7F});
  return pack(lights);
}

View view_from(const glm::dvec3& eye) {
  const DMat4 pose = glm::lookAt(eye, glm::dvec3(8.0, 0.0, 8.0), glm::dvec3(0.0, 1.0, 0.0));
  return View::create(1280, 720, perspective(symmetric_window(1.0, 16.0 / 9.0), 0.05, INFINITE_FAR), pose).value();
}

constexpr std::uint64_t FEWER_THAN_A_SQUARE = 255;
constexpr std::uint64_t ENOUGH_FOR_SPOTS = 300;  // of 16 texels a side, and not for the six squares of a point

class StillShadows : public ::testing::TestWithParam<std::uint32_t> {
 protected:
  ShadowCounts schedule(std::uint64_t budget) {
    return atlas_.schedule({.views = std::span(&view_, 1), .lights = lights_, .budget_texels = budget}).value().counts;
  }

  std::vector<shared::Light> lights_ = lights_on_a_floor(200);
  View view_ = view_from({8.0, 12.0, 24.0});
  ShadowAtlas atlas_ = std::move(ShadowAtlas::create({.size = GetParam(), .light_capacity = 200}).value());
};

// In a small atlas, whose sizes have fallen, and in a large one.
INSTANTIATE_TEST_SUITE_P(Of, StillShadows, ::testing::Values(512U, 4096U));

TEST_P(StillShadows, WaitForNothingWhereNothingCanBeDrawn) {
  ASSERT_EQ(schedule(ALL_TEXELS).without, 0U);
  for (const std::uint64_t budget : {std::uint64_t{0}, FEWER_THAN_A_SQUARE, ALL_TEXELS, std::uint64_t{0}, ALL_TEXELS}) {
    const ShadowCounts counts = schedule(budget);
    EXPECT_EQ(counts.redrawn, 0U) << budget;
    EXPECT_EQ(counts.waiting, 0U) << budget;
    EXPECT_EQ(counts.shadowed, 200U) << budget;
  }
}

TEST_P(StillShadows, KeepTheirSizeWhereTheirLeastSquaresAreBeyondTheBudget) {
  ASSERT_EQ(schedule(ALL_TEXELS).without, 0U);
  for (int i = 0; i < 300; ++i) EXPECT_LE(schedule(ENOUGH_FOR_SPOTS).redrawn, 1U);
  const ShadowCounts last = schedule(ENOUGH_FOR_SPOTS);
  EXPECT_EQ(last.waiting, 0U) << "spots have the least size, and points their own";
  EXPECT_EQ(last.shadowed, 200U);
}

TEST_P(StillShadows, WaitWhereTheyHaveNoMapOrMoved) {
  EXPECT_EQ(schedule(0).waiting, 200U);
  static_cast<void>(schedule(ALL_TEXELS));
  lights_[3].position.x += 1.0F;
  EXPECT_EQ(schedule(0).waiting, 1U);
  EXPECT_EQ(schedule(ALL_TEXELS).redrawn, 1U);
}

TEST(MovedSpheres, ThatAreNotFiniteTouchEveryLight) {
  ShadowAtlas atlas = std::move(ShadowAtlas::create({.light_capacity = 4}).value());
  const std::vector<shared::Light> lights = lights_on_a_floor(4);
  const View view = view_from({8.0, 12.0, 24.0});
  const auto redrawn = [&](const shared::LightSphere& moved) {
    return atlas.schedule({.views = std::span(&view, 1), .lights = lights, .moved = std::span(&moved, 1)})
        .value()
        .counts.redrawn;
  };
  const shared::LightSphere away{.center = {0.0F, 100.0F, 0.0F}, .radius = 1.0F};
  EXPECT_EQ(redrawn(away), 4U) << "the first frame";
  EXPECT_EQ(redrawn(away), 0U);
  for (const float odd : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    EXPECT_EQ(redrawn({.center = {odd, 0.0F, 0.0F}, .radius = 1.0F}), 4U) << odd;
    EXPECT_EQ(redrawn({.center = {0.0F, 0.0F, -odd}, .radius = 1.0F}), 4U) << odd;
    EXPECT_EQ(redrawn({.center = {0.0F, 100.0F, 0.0F}, .radius = odd}), 4U) << odd;
  }
  EXPECT_EQ(redrawn(away), 0U);
}

}  // namespace
}  // namespace lamp
