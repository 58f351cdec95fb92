// The oracle: known answers by hand, and the fast truth against the slow one on random pictures.
// SPDX-License-Identifier: Apache-2.0
#include "oracle/reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <numbers>
#include <vector>

#include "random.h"

namespace {

using lamp::Light;
using lamp::LightType;
using lamp::Reach;
using lamp::View;

constexpr float INFINITE = std::numeric_limits<float>::infinity();
constexpr double DEGREE = std::numbers::pi / 180.0;

Reach ask(const Light& light, const glm::dvec3& position) { return lamp::reach(lamp::pack(light), position); }

Light spot_down(float outer_angle, float range) {
  return {.type = LightType::spot,
          .position = {1.0F, 2.0F, 3.0F},
          .range = range,
          .direction = {0.0F, -1.0F, 0.0F},
          .outer_angle = outer_angle};
}

// The position at an angle off the axis of spot_down.
glm::dvec3 off_axis(double angle, double distance) {
  return glm::dvec3(1.0, 2.0, 3.0) + distance * glm::dvec3(std::sin(angle), -std::cos(angle), 0.0);
}

TEST(Reach, PointLight) {
  const Light light{.position = {1.0F, 2.0F, 3.0F}, .range = 4.0F};
  const glm::dvec3 center(1.0, 2.0, 3.0);
  EXPECT_EQ(ask(light, center), Reach::inside);
  for (const glm::dvec3 axis : {glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0, 0, 1)}) {
    EXPECT_EQ(ask(light, center + 3.9999 * axis), Reach::inside);
    EXPECT_EQ(ask(light, center + 3.99997 * axis), Reach::boundary);
    EXPECT_EQ(ask(light, center + 4.0 * axis), Reach::boundary);
    EXPECT_EQ(ask(light, center + 4.00003 * axis), Reach::boundary);
    EXPECT_EQ(ask(light, center + 4.0001 * axis), Reach::outside);
    EXPECT_EQ(ask(light, center + 4e6 * axis), Reach::outside);
  }
}

TEST(Reach, RangeZeroReachesNothingAndInfinityEverything) {
  const glm::dvec3 center(1.0, 2.0, 3.0);
  EXPECT_EQ(ask({.position = glm::vec3(center), .range = 0.0F}, center), Reach::outside);
  EXPECT_EQ(ask(spot_down(0.5F, 0.0F), off_axis(0.0, 0.0)), Reach::outside);
  EXPECT_EQ(ask({.position = glm::vec3(center), .range = INFINITE}, glm::dvec3(1e30)), Reach::inside);
  EXPECT_EQ(ask(spot_down(0.5F, INFINITE), off_axis(0.4, 1e30)), Reach::inside);
  EXPECT_EQ(ask(spot_down(0.5F, INFINITE), off_axis(0.6, 1e30)), Reach::outside);
  for (const float range : {1e18F, 2e18F, 1e30F, std::numeric_limits<float>::max()}) {
    EXPECT_EQ(ask({.position = glm::vec3(center), .range = range}, glm::dvec3(1e31)), Reach::inside) << range;
    EXPECT_EQ(ask(spot_down(0.5F, range), off_axis(0.4, 1e31)), Reach::inside) << range;
    EXPECT_EQ(ask(spot_down(0.5F, range), off_axis(0.6, 1e31)), Reach::outside) << range;
  }
  EXPECT_EQ(ask({.position = glm::vec3(center), .range = 9.9e17F}, glm::dvec3(1e18)), Reach::outside);
}

TEST(Reach, SpotConeAtAnyHalfAngle) {
  for (const double degrees : {0.001, 0.5, 1.0, 30.0, 45.0, 89.0, 90.0}) {
    const auto outer_angle = static_cast<float>(degrees * DEGREE);
    const Light light = spot_down(outer_angle, 10.0F);
    const double outer = outer_angle;
    for (const double distance : {1e-6, 1.0, 9.9}) {
      EXPECT_EQ(ask(light, off_axis(0.0, distance)), Reach::inside) << degrees;
      EXPECT_EQ(ask(light, off_axis(outer * (1.0 - 1e-4), distance)), Reach::inside) << degrees;
      EXPECT_EQ(ask(light, off_axis(outer * (1.0 - 5e-6), distance)), Reach::boundary) << degrees;
      EXPECT_EQ(ask(light, off_axis(outer * (1.0 + 5e-6), distance)), Reach::boundary) << degrees;
      EXPECT_EQ(ask(light, off_axis(outer * (1.0 + 1e-4), distance)), Reach::outside) << degrees;
      EXPECT_EQ(ask(light, off_axis(std::numbers::pi, distance)), Reach::outside) << degrees;
    }
  }
}

TEST(Reach, SpotOutsideOneLimitIsOutsideWhateverTheOther) {
  const Light light = spot_down(0.5F, 10.0F);
  EXPECT_EQ(ask(light, off_axis(0.5, 10.1)), Reach::outside);
  EXPECT_EQ(ask(light, off_axis(0.6, 10.0)), Reach::outside);
  EXPECT_EQ(ask(light, off_axis(0.5, 10.0)), Reach::boundary);
  EXPECT_EQ(ask(light, off_axis(0.1, 10.0)), Reach::boundary);
  EXPECT_EQ(ask(light, off_axis(0.0, 0.0)), Reach::boundary);
}

TEST(Reach, HalfAngleZeroReachesNothing) {
  const Light light = spot_down(0.0F, 10.0F);
  EXPECT_EQ(ask(light, off_axis(0.0, 1.0)), Reach::outside);
  EXPECT_EQ(ask(light, off_axis(0.0, 0.0)), Reach::outside);
}

View test_view(std::uint32_t width, std::uint32_t height, const glm::dmat4& clip_from_view) {
  const glm::dmat4 pose = glm::lookAt(glm::dvec3(2.0, 3.0, 9.0), glm::dvec3(0.0), glm::dvec3(0.0, 1.0, 0.0));
  return View::create(width, height, clip_from_view, pose).value();
}

TEST(BruteForceTruth, OnePixelByHand) {
  const View view = test_view(2, 1, lamp::perspective(lamp::symmetric_window(1.0, 2.0), 0.1, lamp::INFINITE_FAR));
  const std::vector<float> depth{0.0F, 0.02F};  // sky, and 5 m ahead
  const glm::vec3 hit(view.world_position(1, 0, depth[1]));
  EXPECT_NEAR(view.z_view(depth[1]), 5.0, 1e-5);
  const std::vector<Light> lights{{.position = hit + glm::vec3(3.0F, 0.0F, 0.0F), .range = 2.0F},
                                  {.position = hit + glm::vec3(3.0F, 0.0F, 0.0F), .range = 4.0F},
                                  {.position = hit, .range = 0.0F},
                                  {.position = hit + glm::vec3(3.0F, 0.0F, 0.0F), .range = 3.0F},
                                  {.range = INFINITE}};
  const auto packed = lamp::pack(lights);
  const lamp::Truth truth = lamp::brute_force_truth({.view = view, .depth = depth, .lights = packed, .rows = 1});
  EXPECT_EQ(truth.offsets, (std::vector<std::uint32_t>{0, 0, 2}));
  EXPECT_EQ(truth.lights, (std::vector<std::uint32_t>{1, 4}));
  EXPECT_EQ(truth.boundary_pairs, 1U);
}

using lamp::test::RandomDoubles;

Light random_light(RandomDoubles& random) {
  Light light;
  light.position = glm::vec3(random.vector(12.0));
  const std::uint32_t kind = random.below(20);
  light.range = static_cast<float>(std::exp(random.in(std::log(0.05), std::log(8.0))));
  if (kind == 0) light.range = 0.0F;
  if (kind == 1) light.range = INFINITE;
  if (random.below(2) == 0) return light;
  light.type = LightType::spot;
  light.direction = glm::vec3(random.vector(1.0)) + glm::vec3(0.0F, 1e-3F, 0.0F);
  light.outer_angle = static_cast<float>(random.in(0.5, 90.0) * DEGREE);
  if (kind == 2) light.outer_angle = 0.0F;
  if (kind == 3) light.outer_angle = std::numbers::pi_v<float> / 2.0F;
  return light;
}

lamp::shared::OrientedBox random_box(RandomDoubles& random) {
  const glm::dvec3 x = random.direction();
  const glm::dvec3 y = glm::normalize(glm::cross(x, random.direction()));
  return {.center = glm::vec3(random.vector(12.0)),
          .axis_x = glm::vec3(x),
          .axis_y = glm::vec3(y),
          .axis_z = glm::vec3(glm::cross(x, y)),
          .half_extents = glm::vec3(random.in(0.1, 4.0), random.in(0.1, 4.0), random.in(0.1, 4.0))};
}

// Depth of steps and slopes, with sky between them.
std::vector<float> random_depth(RandomDoubles& random, const View& view) {
  std::vector<float> depth(std::size_t{view.width()} * view.height());
  const double step = random.in(3.0, 40.0);
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const std::size_t row = i / view.width();
    const double x = static_cast<double>(i % view.width());
    const double y = static_cast<double>(row);
    const double z = 6.0 + 4.0 * std::sin(std::floor(x / step)) + 0.02 * y;
    const glm::dvec4 clip = glm::dmat4(view.clip_from_view()) * glm::dvec4(0.0, 0.0, -z, 1.0);
    depth[i] = std::sin(x / step * 3.0 + y / step) > 0.8 ? 0.0F : static_cast<float>(clip.z / clip.w);
  }
  return depth;
}

void expect_same(const lamp::Truth& fast, const lamp::Truth& slow) {
  EXPECT_EQ(fast.first_row, slow.first_row);
  EXPECT_EQ(fast.rows, slow.rows);
  EXPECT_EQ(fast.offsets, slow.offsets);
  EXPECT_EQ(fast.lights, slow.lights);
  EXPECT_EQ(fast.boundary_pairs, slow.boundary_pairs);
}

TEST(Truth, EqualsBruteForceOnRandomPictures) {
  RandomDoubles random(20240607);
  const std::vector<glm::dmat4> projections{
      lamp::perspective(lamp::symmetric_window(1.1, 1.5), 0.05, lamp::INFINITE_FAR),
      lamp::perspective({.left = -0.2, .right = 1.0, .bottom = -0.3, .top = 0.6}, 0.1, 100.0),
      lamp::orthographic({.left = -6.0, .right = 6.0, .bottom = -4.0, .top = 4.0}, 0.0, 50.0)};
  std::size_t pairs = 0;
  for (int round = 0; round < 12; ++round) {
    SCOPED_TRACE(round);
    const View view = test_view(1 + random.below(150), 1 + random.below(90), projections[round % projections.size()]);
    const std::vector<float> depth = random_depth(random, view);
    std::vector<Light> lights(random.below(300));
    for (Light& light : lights) light = random_light(random);
    ASSERT_FALSE(lamp::check_lights(lights).has_value());
    const auto packed = lamp::pack(lights);
    std::vector<lamp::shared::OrientedBox> boxes(random.below(100));
    for (lamp::shared::OrientedBox& box : boxes) box = random_box(random);
    const lamp::TruthQuery query{.view = view, .depth = depth, .lights = packed, .rows = view.height(), .boxes = boxes};
    const lamp::Truth slow = lamp::brute_force_truth(query);
    expect_same(lamp::truth(query), slow);
    pairs += slow.lights.size();
  }
  EXPECT_GT(pairs, 100000U);
}

TEST(Truth, CountsTheBoundaryAsBruteForceDoes) {
  const View view =
      test_view(70, 40, lamp::orthographic({.left = -4.0, .right = 4.0, .bottom = -4.0, .top = 4.0}, 0.0, 10.0));
  const std::vector<float> depth(70 * 40, 0.5F);
  std::vector<Light> lights;
  for (std::uint32_t i = 0; i < 200; ++i) {
    const glm::dvec3 near_by = view.world_position(i % 70, i % 40, 0.5);
    lights.push_back({.position = glm::vec3(near_by) + glm::vec3(0.0F, 2.0F, 0.0F), .range = 2.0F});
  }
  const auto packed = lamp::pack(lights);
  const lamp::TruthQuery query{.view = view, .depth = depth, .lights = packed, .rows = 40};
  const lamp::Truth slow = lamp::brute_force_truth(query);
  EXPECT_GE(slow.boundary_pairs, 200U);
  expect_same(lamp::truth(query), slow);
}

TEST(Truth, AnswersForSomeRows) {
  RandomDoubles random(7);
  const View view = test_view(90, 70, lamp::perspective(lamp::symmetric_window(1.1, 1.5), 0.05, lamp::INFINITE_FAR));
  const std::vector<float> depth = random_depth(random, view);
  std::vector<Light> lights(100);
  for (Light& light : lights) light = random_light(random);
  const auto packed = lamp::pack(lights);
  const lamp::Truth whole = lamp::truth({.view = view, .depth = depth, .lights = packed, .rows = 70});
  const lamp::TruthQuery some{.view = view, .depth = depth, .lights = packed, .first_row = 5, .rows = 65};
  const lamp::Truth part = lamp::truth(some);
  expect_same(part, lamp::brute_force_truth(some));
  const auto first = whole.lights.begin() + whole.offsets[std::size_t{5} * 90];
  EXPECT_TRUE(std::equal(part.lights.begin(), part.lights.end(), first));
  expect_same(lamp::truth({.view = view, .depth = depth, .lights = packed, .first_row = 70, .rows = 0}),
              lamp::Truth{.first_row = 70, .rows = 0, .offsets = {0}});
}

TEST(Truth, SkyAndNoLights) {
  const View view = test_view(9, 7, lamp::perspective(lamp::symmetric_window(1.1, 1.5), 0.05, lamp::INFINITE_FAR));
  const lamp::Truth none{.rows = 7, .offsets = std::vector<std::uint32_t>(64, 0)};
  const auto packed = lamp::pack(std::vector<Light>(3));
  const std::vector<float> sky(63, 0.0F);
  const std::vector<float> wall(63, 0.1F);
  expect_same(lamp::truth({.view = view, .depth = sky, .lights = packed, .rows = 7}), none);
  expect_same(lamp::truth({.view = view, .depth = wall, .lights = {}, .rows = 7}), none);
}

}  // namespace
