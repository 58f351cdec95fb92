// Look-ups by position of every method that has one for moving lights: no light missed at any point, whatever the
// lights; ids ascend where the method says so.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "gpu/point_asks.h"
#include "gpu/test_lights.h"
#include "gpu/test_scenes.h"
#include "just_reaching.h"
#include "random.h"
#include "scene/flight.h"
#include "scene/random_points.h"

namespace lamp::app {
namespace {

constexpr std::size_t POINTS = 2000;  // of each kind
constexpr std::uint32_t LIGHTS = 1000;
constexpr float INF = std::numeric_limits<float>::infinity();

using test::lights_around;
using test::Points;
using test::points_in;

std::vector<Method> moving_world_methods() {
  std::vector<Method> found;
  std::ranges::copy_if(methods(), std::back_inserter(found), [](const Method& m) { return m.any_point && !m.still; });
  return found;
}

class WorldPoints : public GpuTest, public ::testing::WithParamInterface<Method> {
 protected:
  /// Of world cells with a bit for each slice as well.
  static Answered ask(Asked asked) {
    if (GetParam().name == "world-cells") {
      asked.settings = {"cells=16"};
      EXPECT_EQ(answer(GetParam(), asked).findings.reason(), "");
      asked.settings = {};
    }
    return answer(GetParam(), asked);
  }
};

TEST_P(WorldPoints, MissNoLightInAnyScene) {
  for (const BuiltinScene& of : builtin_scenes()) {
    SCOPED_TRACE(of.name);
    const TestScene& scene = builtin_test_scene(of.name);
    Asked asked{.view = view_of(find_camera(scene.scene, ""), ASK_SIDE, ASK_SIDE, "infinite")};
    asked.lights = test_lights(scene.air, asked.view, {.count = LIGHTS});
    const PointSource source(scene.scene, scene.air, glm::vec3(glm::dmat4(asked.view.world_from_view())[3]));
    for (const PointKind kind : POINT_KINDS)
      for (const glm::vec3& point : source.draw(kind, POINTS, 1)) asked.points.push_back(point);
    EXPECT_GE(asked.points.size(), 4 * POINTS);
    const Answered answered = ask(asked);
    EXPECT_GT(answered.findings.useful, asked.points.size());
    EXPECT_EQ(answered.counters.overflowed_cells, 0);
  }
}

TEST_P(WorldPoints, AreRightAHundredKilometresAway) {
  const glm::vec3 there(1e5F, -1e5F, 1e5F);
  for (const glm::vec3& eye : {there, glm::vec3(0.0F)}) {
    const Asked asked{.view = view_from(eye),
                      .lights = lights_around(there, 20.0F, 1.0F, 8.0F, LIGHTS),
                      .points = points_in(1, POINTS, there - 20.0F, there + 20.0F)};
    EXPECT_GT(ask(asked).findings.useful, POINTS);
  }
}

TEST_P(WorldPoints, KnowLightsOfEveryRange) {
  const auto [lights, points] = test::lights_of_every_range();
  const Answered answered = ask({.lights = pack(lights), .points = points});
  EXPECT_GT(answered.findings.useful, 3 * points.size());
}

// Seen from the corner of the least brick, a place is rounded by more than such a range.
TEST_P(WorldPoints, KnowLightsOfNanometresAtTheOrigin) {
  for (const float range : {3e-9F, 2e-7F, 5e-5F}) {
    SCOPED_TRACE(range);
    Asked asked;
    for (const glm::vec3& place : points_in(7, 200, glm::vec3(-8.0F * range), glm::vec3(8.0F * range)))
      asked.lights.push_back(pack(Light{.position = place, .range = range}));
    asked.points = points_in(8, 1000, glm::vec3(-8.0F * range), glm::vec3(8.0F * range));
    EXPECT_GT(ask(asked).findings.useful, 10U);
  }
}

/// Cells are cubes between whole multiples of powers of two. Of one cell, such a light has no more than a corner: the
/// end of its range, or the side of its cone.
TEST_P(WorldPoints, KnowLightsThatOnlyJustReachACell) {
  test::RandomDoubles random(3);
  Asked asked;
  while (asked.lights.size() < LIGHTS) {
    const double range = std::exp(random.in(std::log(0.1), std::log(30.0)));
    const double side = std::exp2(std::floor(std::log2(range)) - std::floor(random.in(-1.0, 4.0)));
    const glm::dvec3 sign = glm::sign(random.direction());
    const glm::dvec3 point = side * glm::floor(random.vector(8.0)) + 2e-5 * range * sign;
    const glm::dvec3 towards = sign * glm::abs(random.direction());
    const glm::dvec3 across = glm::normalize(glm::cross(towards, random.direction()));
    const glm::dvec3 outside = glm::dot(across, sign) < 0.0 ? across : -across;
    asked.lights.push_back(pack(asked.lights.size() % 2 == 0
                                    ? test::spot_just_reaching(point, towards, range, outside, random.in(0.05, 1.5))
                                    : test::point_just_reaching(point, towards, range)));
    asked.points.emplace_back(point);
  }
  EXPECT_GE(ask(asked).findings.useful, LIGHTS);
}

TEST_P(WorldPoints, NameTheLightsOfInfiniteRangeWherePositionsAreNone) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::vector<shared::Light> lights = lights_around({}, 1.0F, 0.5F, 1.5F, 100);
  lights.push_back(pack(Light{}));
  const Asked asked{.lights = lights, .points = {{INF, 0, 0}, {0, -INF, INF}, {nan, 0, 0}, {3e38F, 3e38F, -3e38F}}};
  PointWalks walks(test_context(), shader_library(), plan_of(GetParam(), asked), asked.view, asked.lights);
  const PointLights found = walks.walk(asked.points);
  for (std::size_t point = 0; point < asked.points.size(); ++point) {
    const auto walked = found.of(point);
    EXPECT_EQ(std::ranges::count(walked, 100U), 1) << point;
    EXPECT_TRUE(walked.size() == 1 || point == 3) << point;  // the last is a position
  }
}

TEST_P(WorldPoints, TakeAllLightsInOneCell) {
  for (const std::uint32_t count : {129U, 2000U}) {
    SCOPED_TRACE(count);
    const Asked asked{.lights = lights_around(glm::vec3(0.37F), 0.001F, 0.4F, 0.5F, count),
                      .points = points_in(1, 64, glm::vec3(0.0F), glm::vec3(0.7F))};
    ask(asked);
  }
}

TEST_P(WorldPoints, AreTheSameInEveryRun) {
  const Asked asked{.lights = lights_around({}, 5.0F, 1.0F, 4.0F, LIGHTS),
                    .points = points_in(1, POINTS, glm::vec3(-5.0F), glm::vec3(5.0F))};
  PointWalks walks(test_context(), shader_library(), plan_of(GetParam(), asked), asked.view, asked.lights);
  const PointLights first = walks.walk(asked.points);
  for (int run = 0; run < 3; ++run) EXPECT_EQ(walks.walk(asked.points).lights, first.lights);
}

TEST_P(WorldPoints, AreTheSameHoweverManyLightsComeAtOnce) {
  const Asked asked{.lights = lights_around({}, 5.0F, 1.0F, 4.0F, 100),
                    .points = points_in(1, 100, glm::vec3(-5.0F), glm::vec3(5.0F))};
  PointWalks walks(test_context(), shader_library(), plan_of(GetParam(), asked), asked.view, asked.lights);
  const PointLights together = walks.walk(asked.points);
  EXPECT_GT(together.lights.size(), asked.points.size());
  for (const std::uint64_t lights : {1U, 20U}) {
    walks.list_at_once(lights);
    const PointLights apart = walks.walk(asked.points);
    EXPECT_EQ(apart.lights, together.lights);
    EXPECT_EQ(apart.offsets, together.offsets);
    EXPECT_EQ(apart.ended, together.ended);
  }
}

INSTANTIATE_TEST_SUITE_P(Of, WorldPoints, ::testing::ValuesIn(moving_world_methods()),
                         [](const auto& test) { return test_name(std::string(test.param.name)); });

}  // namespace
}  // namespace lamp::app
