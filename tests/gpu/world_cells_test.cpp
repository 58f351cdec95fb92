// The look-up by position of `world-cells`: what is its own, beside world_points_test.cpp.
// SPDX-License-Identifier: Apache-2.0
#include "gpu/point_asks.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <string>

#include "gpu/check.h"

namespace lamp::app {
namespace {

constexpr std::size_t POINTS = 2000;
constexpr std::uint32_t LIGHTS = 1000;

using test::lights_around;
using test::Points;
using test::points_in;

Answered ask(const Asked& asked) { return answer(*take(find_method("world-cells")), asked); }

void make_narrow(shared::Light& light) {
  light.type = shared::LIGHT_SPOT;
  light.outer_angle = 0.1F;
  light.sin_outer = std::sin(light.outer_angle);
  light.cos_outer = std::cos(light.outer_angle);
}

class WorldCells : public GpuTest {};

TEST_F(WorldCells, WalkLittleMoreThanWhatReachesAPoint) {
  const Asked asked{.lights = lights_around({}, 10.0F, 1.0F, 4.0F, LIGHTS),
                    .points = points_in(1, POINTS, glm::vec3(-10.0F), glm::vec3(10.0F))};
  const Answered answered = ask(asked);
  EXPECT_LT(answered.findings.waste(), 2.3);
  EXPECT_GT(answered.findings.useful, 5 * POINTS);
}

// Large bricks, and spots that are narrow and long.
TEST_F(WorldCells, OfSlicesWalkLittleWhereBricksAreLarge) {
  std::vector<shared::Light> lights = lights_around({}, 10.0F, 1.0F, 4.0F, LIGHTS);
  const Points points = points_in(1, POINTS, glm::vec3(-10.0F), glm::vec3(10.0F));
  const auto waste = [&](const char* cells) {
    return ask({.lights = lights, .points = points, .settings = {"brick=300", cells}}).findings.waste();
  };
  EXPECT_LT(waste("cells=16"), 3.0);
  EXPECT_GT(waste("cells=4"), 4.0) << "for this slices are";
  for (shared::Light& light : lights) make_narrow(light);
  ask({.lights = lights, .points = points, .settings = {"cells=16"}});
}

// Where no light is, most bricks share their bucket with one that has lights.
TEST_F(WorldCells, PassOverLightsOfOtherBricks) {
  const std::vector<shared::Light> lights = lights_around({}, 100.0F, 1.0F, 4.0F, LIGHTS);
  const Points points = points_in(1, POINTS, glm::vec3(1000.0F), glm::vec3(2000.0F));
  for (const char* cells : {"cells=4", "cells=16"})
    EXPECT_LT(ask({.lights = lights, .points = points, .settings = {cells}}).findings.evaluations, POINTS / 50)
        << cells;
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

TEST_F(WorldCells, WalkEveryLightWhereRoomIsLacking) {
  const Asked asked{.lights = lights_around({}, 10.0F, 1.0F, 4.0F, LIGHTS),
                    .points = points_in(1, POINTS, glm::vec3(-10.0F), glm::vec3(10.0F)),
                    .settings = {"mean_bricks=1"}};
  const Answered answered = ask(asked);
  EXPECT_GT(answered.counters.overflowed_cells, 0);
  EXPECT_GT(answered.counters.entries_needed, LIGHTS);
  EXPECT_EQ(answered.findings.list_max, LIGHTS);
}

// Where a device ends loops, as many lights as the plan says.
TEST_F(WorldCells, WalkToTheEndOfWhatTheDeviceLets) {
  constexpr std::uint32_t MOST = 65535 / 8 / 2;  // the check walks twice
  const Answered answered = ask({.lights = lights_around({}, 10.0F, 1.0F, 4.0F, MOST),
                                 .points = points_in(1, 64, glm::vec3(-10.0F), glm::vec3(10.0F)),
                                 .settings = {"mean_bricks=1"}});
  EXPECT_EQ(answered.findings.list_max, MOST);
  EXPECT_EQ(answered.findings.unfollowed, 0U);
}

// There is room for all entries, and little more.
TEST_F(WorldCells, KeepWhatGroupsFindWhereRoomIsScarce) {
  const Asked asked{.lights = lights_around({}, 10.0F, 1.0F, 4.0F, LIGHTS),
                    .points = points_in(1, POINTS, glm::vec3(-10.0F), glm::vec3(10.0F)),
                    .settings = {"mean_bricks=13"}};
  const Answered answered = ask(asked);
  EXPECT_EQ(answered.counters.overflowed_cells, 0);
  EXPECT_LT(answered.findings.waste(), 2.3);
}

// There is room for all entries, but not for all that the groups of the first lights find: the others are narrow and
// reach few bricks.
TEST_F(WorldCells, LookForBricksAgainWhereAGroupFindsMoreThanItHasRoomFor) {
  Asked asked{.lights = lights_around({}, 10.0F, 1.0F, 4.0F, LIGHTS),
              .points = points_in(1, POINTS, glm::vec3(-10.0F), glm::vec3(10.0F)),
              .settings = {"mean_bricks=10"}};
  for (shared::Light& light : std::span(asked.lights).first(LIGHTS / 2)) light.type = shared::LIGHT_POINT;
  for (shared::Light& light : std::span(asked.lights).last(LIGHTS / 2)) make_narrow(light);
  const Answered answered = ask(asked);
  EXPECT_EQ(answered.counters.overflowed_cells, 0);
  EXPECT_GT(answered.counters.entries_needed, 7 * LIGHTS) << "half of the lights must find more than the mean";
}

// All of a group's boxes are as large as boxes are: its list of bricks has room for most of them.
TEST_F(WorldCells, TestBricksBeyondTheList) {
  const std::vector<shared::Light> lights = lights_around(glm::vec3(1.0F), 0.01F, 1.98F, 1.99F, LIGHTS);
  ask({.lights = lights, .points = points_in(1, 300, glm::vec3(-1.0F), glm::vec3(3.0F))});
}

// Where a device takes few groups each has several turns: four, and three.
TEST_F(WorldCells, FindBricksInTurns) {
  for (const std::uint32_t groups : {8U, 11U}) {
    SCOPED_TRACE(groups);
    ask({.lights = lights_around({}, 10.0F, 1.0F, 4.0F, LIGHTS),
         .points = points_in(1, POINTS, glm::vec3(-10.0F), glm::vec3(10.0F)),
         .max_groups = groups});
  }
}

// Octets, words, pieces and what a work group takes, each a little less than full, full, and a little more.
TEST_F(WorldCells, TakeListsOfEveryLength) {
  for (const char* cells : {"cells=4", "cells=16"})
    for (const std::uint32_t length :
         {1, 7, 8, 9, 31, 32, 33, 63, 64, 65, 127, 128, 129, 191, 256, 257, 383, 384, 385, 768, 769, 1000}) {
      SCOPED_TRACE(cells + (" " + std::to_string(length)));
      std::vector<shared::Light> lights = lights_around({}, 0.1F, 1.0F, 1.1F, length);
      for (shared::Light& light : lights) light.type = shared::LIGHT_POINT;
      const Answered answered =
          ask({.lights = lights, .points = points_in(1, 300, glm::vec3(-1.2F), glm::vec3(1.2F)), .settings = {cells}});
      EXPECT_EQ(answered.findings.list_max, length);
    }
}

// One of the first lights and many of the last: nearly all of a list falls into one bin of its sort.
TEST_F(WorldCells, OrderListsWhoseLightsHaveUnevenNumbers) {
  for (const std::uint32_t last : {150, 600}) {
    std::vector<shared::Light> lights = lights_around({}, 0.1F, 1.0F, 1.1F, last);
    for (shared::Light& light : lights) light.type = shared::LIGHT_POINT;
    shared::Light nothing = lights.front();
    nothing.range = 0.0F;
    lights.insert(lights.begin() + 1, 40'000, nothing);
    const Answered answered = ask({.lights = lights, .points = points_in(1, 300, glm::vec3(-1.2F), glm::vec3(1.2F))});
    EXPECT_EQ(answered.findings.list_max, last);
  }
}

TEST_F(WorldCells, TakeBricksOfEverySize) {
  for (const char* brick : {"brick=50", "brick=63", "brick=250", "brick=1600"})
    for (const char* cells : {"cells=4", "cells=16"}) {
      SCOPED_TRACE(std::string(brick) + " " + cells);
      ask({.lights = lights_around({}, 10.0F, 0.01F, 4.0F, LIGHTS),
           .points = points_in(1, POINTS, glm::vec3(-10.0F), glm::vec3(10.0F)),
           .settings = {brick, cells}});
    }
}

}  // namespace
}  // namespace lamp::app
