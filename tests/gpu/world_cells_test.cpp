// The look-up by position of `world-cells`: no light missed at any point, whatever the lights; ids ascend.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "gpu/test_lights.h"
#include "gpu/test_scenes.h"
#include "render/point_check.h"
#include "scene/flight.h"
#include "scene/procedural_random.h"
#include "scene/random_points.h"
#include "world_lights.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t SIDE = 64;    // pixels: the picture does not matter
constexpr std::size_t POINTS = 2000;  // of each kind
constexpr std::uint32_t LIGHTS = 1000;
constexpr float INF = std::numeric_limits<float>::infinity();

using procedural::Random;
using test::lights_around;
using test::Points;
using test::points_in;

View view_from(const glm::vec3& eye) {
  Camera camera{.name = "any"};
  camera.world_from_camera[3] = glm::vec4(eye, 1.0F);
  return view_of(camera, SIDE, SIDE, "infinite");
}

struct Asked {
  View view = view_from({});
  std::vector<shared::Light> lights;
  Points points;
  std::vector<std::string> settings;
};

Plan plan_of(const Asked& asked) {
  const Method& method = *take(find_method("world-cells"));
  return take(make_plan(method, {.width = SIDE,
                                 .height = SIDE,
                                 .light_capacity = static_cast<std::uint32_t>(asked.lights.size()),
                                 .options = take(resolve_options(method, asked.settings)),
                                 .traits = test_context().device().traits}));
}

struct Answered {
  PointFindings findings;
  PointLights lights;
  shared::Counters counters;
};

/// Expects no miss, and ids that ascend.
Answered ask(const Asked& asked) {
  PointWalks walks(test_context(), shader_library(), plan_of(asked), asked.view, asked.lights);
  Answered answered{.lights = walks.walk(asked.points)};
  answered.findings = check_points(answered.lights, truth_at(asked.points, asked.lights), asked.lights.size());
  answered.counters = walks.counts().counters;
  EXPECT_EQ(answered.findings.reason(), "");
  return answered;
}

class WorldCells : public GpuTest {};

class WorldCellsInScene : public GpuTest, public ::testing::WithParamInterface<BuiltinScene> {};

TEST_P(WorldCellsInScene, MissNoLightAtRandomPoints) {
  const TestScene& scene = builtin_test_scene(GetParam().name);
  Asked asked{.view = view_of(find_camera(scene.scene, ""), SIDE, SIDE, "infinite")};
  asked.lights = test_lights(scene.air, asked.view, {.count = LIGHTS});
  const PointSource source(scene.scene, scene.air, glm::vec3(glm::dmat4(asked.view.world_from_view())[3]));
  for (const PointKind kind : POINT_KINDS)
    for (const glm::vec3& point : source.draw(kind, POINTS, 1)) asked.points.push_back(point);
  EXPECT_GE(asked.points.size(), 4 * POINTS);
  const Answered answered = ask(asked);
  EXPECT_GT(answered.findings.useful, asked.points.size());
  EXPECT_EQ(answered.counters.overflowed_cells, 0);
}

INSTANTIATE_TEST_SUITE_P(Of, WorldCellsInScene, ::testing::ValuesIn(builtin_scenes()),
                         [](const auto& test) { return test_name(test.param.name); });

TEST_F(WorldCells, WalkLittleMoreThanWhatReachesAPoint) {
  const Asked asked{.lights = lights_around({}, 10.0F, 1.0F, 4.0F, LIGHTS),
                    .points = points_in(1, POINTS, glm::vec3(-10.0F), glm::vec3(10.0F))};
  const Answered answered = ask(asked);
  EXPECT_LT(answered.findings.waste(), 2.3);
  EXPECT_GT(answered.findings.useful, 5 * POINTS);
}

TEST_F(WorldCells, AreRightAHundredKilometresAway) {
  const glm::vec3 there(1e5F, -1e5F, 1e5F);
  for (const glm::vec3& eye : {there, glm::vec3(0.0F)}) {
    const Asked asked{.view = view_from(eye),
                      .lights = lights_around(there, 20.0F, 1.0F, 8.0F, LIGHTS),
                      .points = points_in(1, POINTS, there - 20.0F, there + 20.0F)};
    EXPECT_GT(ask(asked).findings.useful, POINTS);
  }
}

TEST_F(WorldCells, KnowLightsOfEveryRange) {
  std::vector<Light> lights;
  Points points;
  Random random(5);
  for (int exponent = -20; exponent <= 59; ++exponent) {
    const float range = std::ldexp(random.between(1.0F, 2.0F), exponent);
    lights.push_back({.position = {range, 0.0F, 0.0F}, .range = range});
    points.emplace_back(range * 0.25F, 0.0F, 0.0F);
    points.emplace_back(range * 1.5F, -0.5F * range, 0.0F);
  }
  for (const float range : {0.0F, 1e18F, 3e38F, INF}) lights.push_back({.position{}, .range = range});
  const Answered answered = ask({.lights = pack(lights), .points = points});
  EXPECT_GT(answered.findings.useful, 3 * points.size());
}

// More levels at a point than a walk keeps, with more lights of each than a word of bits.
TEST_F(WorldCells, MergeManyLevelsOfManyLights) {
  std::vector<shared::Light> lights;
  for (const float range : {0.5F, 1.0F, 2.0F, 4.0F, 8.0F, 16.0F, 32.0F})
    for (const shared::Light& light : lights_around({}, 0.4F * range, range, 1.9F * range, 150))
      lights.push_back(light);
  std::ranges::shuffle(lights, std::mt19937(9));
  const Answered answered = ask({.lights = lights, .points = points_in(1, 300, glm::vec3(-1.0F), glm::vec3(1.0F))});
  EXPECT_GT(answered.findings.useful, 300 * 100);
}

// A brick's own coordinate of such a position rounds up to the next brick's.
TEST_F(WorldCells, AreRightJustBelowAFaceOfABrick) {
  Points points;
  for (const float below : {-1e-3F, -1e-6F, -1e-9F, -1e-20F, -1e-40F, -0.0F})
    for (int axis = 0; axis < 3; ++axis) {
      glm::vec3 point(0.7F);
      point[axis] = below;
      points.push_back(point);
    }
  ask({.lights = lights_around({}, 1.0F, 0.5F, 1.5F, LIGHTS), .points = points});
}

TEST_F(WorldCells, NameTheLightsOfInfiniteRangeWherePositionsAreNone) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::vector<shared::Light> lights = lights_around({}, 1.0F, 0.5F, 1.5F, 100);
  lights.push_back(pack(Light{}));
  const Asked asked{.lights = lights, .points = {{INF, 0, 0}, {0, -INF, INF}, {nan, 0, 0}, {3e38F, 3e38F, -3e38F}}};
  PointWalks walks(test_context(), shader_library(), plan_of(asked), asked.view, asked.lights);
  const PointLights found = walks.walk(asked.points);
  for (std::size_t point = 0; point < asked.points.size(); ++point) {
    ASSERT_EQ(found.of(point).size(), 1) << point;
    EXPECT_EQ(found.of(point)[0], 100) << point;
  }
}

TEST_F(WorldCells, TakeAllLightsInOneCell) {
  for (const std::uint32_t count : {129U, 2000U}) {
    SCOPED_TRACE(count);
    const Asked asked{.lights = lights_around(glm::vec3(0.37F), 0.001F, 0.4F, 0.5F, count),
                      .points = points_in(1, 64, glm::vec3(0.0F), glm::vec3(0.7F))};
    ask(asked);
  }
}

TEST_F(WorldCells, WalkEveryLightWhereRoomIsLacking) {
  const Asked asked{.lights = lights_around({}, 10.0F, 1.0F, 4.0F, LIGHTS),
                    .points = points_in(1, POINTS, glm::vec3(-10.0F), glm::vec3(10.0F)),
                    .settings = {"mean_bricks=1"}};
  const Answered answered = ask(asked);
  EXPECT_GT(answered.counters.overflowed_cells, 0);
  EXPECT_GT(answered.counters.entries_needed, LIGHTS);
  EXPECT_EQ(answered.findings.list_max, LIGHTS);
}

TEST_F(WorldCells, AreTheSameInEveryRun) {
  const Asked asked{.lights = lights_around({}, 5.0F, 1.0F, 4.0F, LIGHTS),
                    .points = points_in(1, POINTS, glm::vec3(-5.0F), glm::vec3(5.0F))};
  PointWalks walks(test_context(), shader_library(), plan_of(asked), asked.view, asked.lights);
  const PointLights first = walks.walk(asked.points);
  for (int run = 0; run < 3; ++run) EXPECT_EQ(walks.walk(asked.points).lights, first.lights);
}

TEST_F(WorldCells, TakeBricksOfEverySize) {
  for (const char* brick : {"brick=50", "brick=63", "brick=250", "brick=1600"}) {
    SCOPED_TRACE(brick);
    ask({.lights = lights_around({}, 10.0F, 0.01F, 4.0F, LIGHTS),
         .points = points_in(1, POINTS, glm::vec3(-10.0F), glm::vec3(10.0F)),
         .settings = {brick}});
  }
}

}  // namespace
}  // namespace lamp::app
