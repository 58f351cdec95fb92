// Lists of lights for triangles: random lights and triangles against the oracle's definition, known answers, bad input.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/triangle_lists.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "lamplight/light.h"
#include "oracle/reference.h"
#include "random.h"

namespace {

using lamp::Light;
using lamp::LightType;
using lamp::StillTriangle;
using lamp::TriangleLists;
using lamp::TriangleListsInfo;

using lamp::test::RandomDoubles;

std::vector<lamp::shared::Light> random_lights(RandomDoubles& random, int count, double half, double range) {
  std::vector<Light> lights;
  for (int i = 0; i < count; ++i) {
    Light light;
    light.position = lamp::Vec3(glm::vec3(random.vector(half)));
    light.range = static_cast<float>(random.in(0.3, 1.0) * range);
    light.type = i % 2 == 0 ? LightType::point : LightType::spot;
    light.direction = lamp::Vec3(glm::vec3(random.vector(1.0) + glm::dvec3(0.0, 1e-3, 0.0)));
    light.outer_angle = i % 8 == 1 ? std::numbers::pi_v<float> / 2.0F : static_cast<float>(random.in(0.05, 1.5));
    lights.push_back(light);
  }
  return lamp::pack(lights);
}

StillTriangle triangle_of(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return {.corners = {lamp::DVec3(a), lamp::DVec3(b), lamp::DVec3(c)}};
}

glm::dvec3 point_on(RandomDoubles& random, const StillTriangle& t) {
  double u = random.in(0.0, 1.0);
  double v = random.in(0.0, 1.0);
  if (u + v > 1.0) {
    u = 1.0 - u;
    v = 1.0 - v;
  }
  const glm::dvec3 a(t.corners[0]);
  return a + u * (glm::dvec3(t.corners[1]) - a) + v * (glm::dvec3(t.corners[2]) - a);
}

TriangleLists made(const TriangleListsInfo& info) {
  auto lists = lamp::make_triangle_lists(info);
  EXPECT_TRUE(lists.ok()) << lists.error().text();
  return lists.ok() ? std::move(lists.value()) : TriangleLists{};
}

/// Now and then on a side.
glm::dvec3 point_on_sides_too(RandomDoubles& random, StillTriangle t) {
  if (random.below(3) == 0) t.corners[random.below(3)] = t.corners[random.below(3)];
  return point_on(random, t);
}

/// Lights that surely reach positions on and near triangles are listed there; lists ascend. The mean length of lists.
double expect_complete(const TriangleListsInfo& info, const TriangleLists& lists, RandomDoubles& random, int points) {
  double walked = 0.0;
  for (int i = 0; i < points; ++i) {
    const auto t = static_cast<std::uint32_t>(random.in(0.0, static_cast<double>(info.triangles.size()) - 1e-9));
    glm::dvec3 near = random.vector(1.0);
    near *= 0.99 * info.slack_m / std::max(1e-9, glm::length(near));
    const glm::vec3 position(point_on_sides_too(random, info.triangles[t]) + near);
    const std::vector<std::uint32_t> found = lights_at(lists, t, lamp::Vec3(position));
    EXPECT_TRUE(std::ranges::is_sorted(found, std::less_equal{}));
    walked += static_cast<double>(found.size());
    for (std::uint32_t light = 0; light < info.lights.size(); ++light) {
      if (lamp::reach(info.lights[light], glm::dvec3(position)) != lamp::Reach::inside) continue;
      EXPECT_TRUE(std::ranges::binary_search(found, light)) << "light " << light << " at triangle " << t;
    }
  }
  return walked / points;
}

std::vector<StillTriangle> random_triangles(RandomDoubles& random) {
  std::vector<StillTriangle> triangles;
  for (int i = 0; i < 300; ++i) {
    const glm::dvec3 a = random.vector(10.0);
    const double size = i % 10 == 0 ? 12.0 : 0.8;
    glm::dvec3 flat(1.0);
    if (i % 3 == 0) flat[i / 3 % 3] = 0.0;  // in a plane of the axes
    triangles.push_back(triangle_of(a, a + flat * random.vector(size), a + flat * random.vector(size)));
  }
  return triangles;
}

TEST(TriangleLists, MissNothing) {
  RandomDoubles random(5);
  const std::vector<lamp::shared::Light> lights = random_lights(random, 400, 11.0, 3.0);
  const std::vector<StillTriangle> triangles = random_triangles(random);
  for (const float slack : {0.0F, 0.02F})
    for (const float patch : {0.1F, 0.5F, 1000.0F}) {
      const TriangleListsInfo info{.triangles = triangles, .lights = lights, .slack_m = slack, .patch = patch};
      expect_complete(info, made(info), random, 4000);
    }
}

/// Each at a place near a triangle that is cut, from any side.
TEST(TriangleLists, KnowLightsThatJustReach) {
  RandomDoubles random(13);
  const std::vector<StillTriangle> triangles{triangle_of({-10, 0, -10}, {10, 0.5, -10}, {-10, 0, 10}),
                                             triangle_of({-7, -7, 3}, {7, -7, 3}, {0, 7, 3})};
  constexpr float SLACK = 0.02F;
  std::vector<Light> lights;
  std::vector<glm::vec3> places;
  for (int i = 0; i < 3000; ++i) {
    places.emplace_back(point_on_sides_too(random, triangles[i % 2]) + 0.99 * double{SLACK} * random.direction());
    const double range = random.in(0.5, 3.0);
    const glm::vec3 at(glm::dvec3(places.back()) + range * (1.0 - 2e-5) * random.direction());
    lights.push_back({.position = at, .range = static_cast<float>(range)});
  }
  const std::vector<lamp::shared::Light> packed = lamp::pack(lights);
  for (const float patch : {0.05F, 0.3F}) {
    const TriangleLists lists = made({.triangles = triangles, .lights = packed, .slack_m = SLACK, .patch = patch});
    for (std::uint32_t i = 0; i < places.size(); ++i) {
      ASSERT_EQ(lamp::reach(packed[i], glm::dvec3(places[i])), lamp::Reach::inside);
      EXPECT_TRUE(std::ranges::binary_search(lights_at(lists, i % 2, lamp::Vec3(places[i])), i)) << i;
    }
  }
}

/// Far from the origin, positions of 32 bits lie beside their triangle.
TEST(TriangleLists, KnowThatPositionsAreRounded) {
  constexpr float FAR = 1e5F;
  const double y = double{FAR} + 0.003;
  const std::vector<StillTriangle> triangles{
      triangle_of({FAR - 1, y, FAR - 1}, {FAR - 1, y, FAR + 2}, {FAR + 2, y, FAR - 1})};
  const std::vector<lamp::shared::Light> lights{lamp::pack(Light{.position = {FAR, FAR - 1, FAR}, .range = 1.001F})};
  EXPECT_EQ(lights_at(made({.triangles = triangles, .lights = lights}), 0, {FAR, FAR, FAR}).size(), 1U);
}

TEST(TriangleLists, PatchesWasteLess) {
  RandomDoubles random(6);
  const std::vector<lamp::shared::Light> lights = random_lights(random, 600, 11.0, 2.0);
  const std::vector<StillTriangle> triangles{triangle_of({-10, 0, -10}, {10, 0.5, -10}, {-10, 0, 10})};
  double before = 1e9;
  for (const float patch : {1000.0F, 1.0F, 0.25F, 0.06F}) {
    const TriangleListsInfo info{.triangles = triangles, .lights = lights, .slack_m = 1e-3F, .patch = patch};
    const double mean = expect_complete(info, made(info), random, 2000);
    EXPECT_LT(mean, 1.02 * before) << "but for which points are asked";
    before = mean;
  }
  EXPECT_LT(before, 8.0);
}

/// A cone is told from its sphere, and from the sphere around it.
TEST(TriangleLists, ConesAreExact) {
  Light spot{
      .type = LightType::spot, .position = {0, 1, 0}, .range = 10.0F, .direction = {1, 0, 0}, .outer_angle = 0.5F};
  const auto touches = [&](const StillTriangle& t) {
    const std::vector<lamp::shared::Light> lights{lamp::pack(spot)};
    const std::vector<StillTriangle> triangles{t};
    return !lights_at(made({.triangles = triangles, .lights = lights}), 0, {0, 0, 0}).empty();
  };
  const double meets = 1.0 / std::tan(0.5);  // where the cone meets y = 0
  EXPECT_FALSE(touches(triangle_of({0, 0, -9}, {meets - 0.01, 0, 0}, {0, 0, 9})));
  EXPECT_TRUE(touches(triangle_of({0, 0, -9}, {meets + 0.01, 0, 0}, {0, 0, 9})));
  EXPECT_TRUE(touches(triangle_of({-50, 0, -50}, {50, 0, -50}, {0, 0, 90})));  // around all of the section
  EXPECT_FALSE(touches(triangle_of({-1, 0, -1}, {-1, 2, 0}, {-1, 0, 1})));     // behind it
  EXPECT_FALSE(touches(triangle_of({10.01, 0, -1}, {10.01, 2, 0}, {10.01, 0, 1})));
  EXPECT_TRUE(touches(triangle_of({9.99, 0, -1}, {9.99, 2, 0}, {9.99, 0, 1})));
  spot.outer_angle = 0.0F;
  EXPECT_FALSE(touches(triangle_of({1, 0, -1}, {1, 2, 0}, {1, 0, 1})));
}

TEST(TriangleLists, LightsBehindShadeNothing) {
  const auto listed = [](const lamp::Vec3& at, float tilt, const std::array<lamp::Vec3, 3>& normals, double side = 4.0,
                         float range = 20.0F, float slack_m = 0.0F) {
    StillTriangle floor = triangle_of({0, 0, 0}, {0, 0, side}, {side, 0, 0});
    floor.normals = normals;
    floor.normal_tilt = tilt;
    const std::vector<StillTriangle> triangles{floor};
    const std::vector<lamp::shared::Light> lights{lamp::pack(Light{.position = at, .range = range})};
    return !lights_at(made({.triangles = triangles, .lights = lights, .slack_m = slack_m}), 0, {1, 0, 1}).empty();
  };
  constexpr std::array<lamp::Vec3, 3> UP{lamp::Vec3{0, 1, 0}, {0, 1, 0}, {0, 1, 0}};
  EXPECT_TRUE(listed({1, 1, 1}, 0.0F, UP));
  EXPECT_FALSE(listed({1, -1, 1}, 0.0F, UP));
  EXPECT_TRUE(listed({1, -1, 1}, lamp::ANY_NORMAL, UP));
  EXPECT_TRUE(listed({1, -1, 1}, 0.5F, UP));                         // a normal that leans towards it may see it
  EXPECT_FALSE(listed({1, -10, 1}, 0.1F, UP));                       // and one that leans less may not
  EXPECT_FALSE(listed({1, -1, 1}, 0.1F, UP));                        // from wherever on the triangle
  EXPECT_FALSE(listed({1, -1, 1}, 0.1F, UP, 100.0, 2.0F));           // from wherever it reaches
  EXPECT_TRUE(listed({1, -1e-5F, 1}, 0.0F, UP));                     // rounded
  EXPECT_TRUE(listed({1, -0.01F, 1}, 0.0F, UP, 4.0, 20.0F, 0.02F));  // from a position behind the triangle
  EXPECT_FALSE(listed({1, -0.1F, 1}, 0.0F, UP, 4.0, 20.0F, 0.02F));
  EXPECT_TRUE(listed({9, -0.1F, 1}, 0.0F, {lamp::Vec3{0, 1, 0}, {0, 1, 0}, {1, 1, 0}}));  // rounded towards it
  EXPECT_TRUE(listed({1, -1, 1}, 0.0F, {}));                                              // no normals: not known
}

/// Of a plane that is cut and of small triangles that share lists.
TEST(TriangleLists, NeighboursShare) {
  RandomDoubles random(7);
  const std::vector<lamp::shared::Light> lights = random_lights(random, 400, 10.0, 4.0);
  std::vector<StillTriangle> triangles;
  for (int x = 0; x < 200; ++x)
    for (int z = 0; z < 200; ++z) {
      const glm::dvec3 at(0.1 * x - 10.0, 0.0, 0.1 * z - 10.0);
      triangles.push_back(triangle_of(at, at + glm::dvec3(0, 0, 0.1), at + glm::dvec3(0.1, 0, 0)));
    }
  const TriangleListsInfo info{.triangles = triangles, .lights = lights, .slack_m = 1e-4F};
  const TriangleLists lists = made(info);
  EXPECT_EQ(lists.stats.patches, triangles.size());
  EXPECT_LT(lists.stats.lists, lists.stats.patches / 2);
  EXPECT_LT(lists.bytes(), 16 * triangles.size());
  EXPECT_GT(lists.stats.listed, 2 * triangles.size());
  EXPECT_TRUE(lists.notes.empty());
  EXPECT_EQ(lists.words, made(info).words);
  expect_complete(info, lists, random, 2000);
}

TEST(TriangleLists, BudgetsCoarsenAndSaySo) {
  RandomDoubles random(8);
  const std::vector<lamp::shared::Light> lights = random_lights(random, 300, 10.0, 2.0);
  std::vector<StillTriangle> triangles = random_triangles(random);
  TriangleListsInfo info{.triangles = triangles, .lights = lights};
  const std::uint64_t fine = made(info).bytes();
  info.budget_bytes = fine;
  EXPECT_EQ(made(info).bytes(), fine);
  EXPECT_TRUE(made(info).notes.empty());
  info.budget_bytes = 100;
  const TriangleLists coarsest = made(info);
  std::uint32_t merged = 1;
  for (const std::uint64_t budget : {fine / 2, fine / 3, coarsest.bytes()}) {
    info.budget_bytes = budget;
    const TriangleLists lists = made(info);
    EXPECT_LE(lists.bytes(), budget);
    ASSERT_EQ(lists.notes.size(), 1U);
    EXPECT_NE(lists.notes[0].find(std::to_string(budget)), std::string::npos);
    merged = lists.stats.merged;
    EXPECT_EQ(lists.notes[0].find("neighbours share a list") != std::string::npos, merged > 1) << lists.notes[0];
    expect_complete(info, lists, random, 1000);
  }
  EXPECT_GT(merged, 1U);
  ASSERT_EQ(coarsest.notes.size(), 1U);
  EXPECT_NE(coarsest.notes[0].find("more than the 100 bytes"), std::string::npos) << coarsest.notes[0];
  expect_complete(info, coarsest, random, 1000);
}

/// Builds that are too fine end when the budget is used up. Whole, they would ask for each patch twice and more.
TEST(TriangleLists, BudgetsAreLookedAtAsListsGrow) {
  RandomDoubles random(12);
  const std::vector<lamp::shared::Light> lights = random_lights(random, 3000, 10.0, 2.0);
  const std::vector<StillTriangle> triangles{triangle_of({-10, 0, -10}, {10, 0, -10}, {-10, 0, 10})};
  std::uint64_t asked = 0;
  TriangleListsInfo info{.triangles = triangles, .lights = lights, .patch = 0.05F};
  info.hides = [&](std::uint32_t, std::span<const lamp::DVec3>) {
    ++asked;
    return false;
  };
  const std::uint64_t fine = made(info).bytes();
  const std::uint64_t asked_whole = std::exchange(asked, 0);
  info.budget_bytes = fine / 8;
  const TriangleLists lists = made(info);
  EXPECT_LE(lists.bytes(), info.budget_bytes);
  EXPECT_LT(asked, asked_whole);
}

/// Larger patches change nothing where nothing is cut: neighbours share lists at once.
TEST(TriangleLists, BudgetsOfLightsWithoutRangeAreMetSoon) {
  RandomDoubles random(13);
  std::vector<lamp::shared::Light> lights = random_lights(random, 300, 10.0, 2.0);
  for (lamp::shared::Light& light : lights) light.range = std::numeric_limits<float>::infinity();
  const std::vector<StillTriangle> triangles = random_triangles(random);
  std::uint64_t asked = 0;
  TriangleListsInfo info{.triangles = triangles, .lights = lights};
  info.hides = [&](std::uint32_t, std::span<const lamp::DVec3>) { return ++asked % 2 == 0; };
  const std::uint64_t fine = made(info).bytes();
  const std::uint64_t asked_whole = std::exchange(asked, 0);
  info.budget_bytes = fine / 2;
  const TriangleLists lists = made(info);
  EXPECT_LE(lists.bytes(), info.budget_bytes);
  EXPECT_GT(lists.stats.merged, 1U);
  EXPECT_LT(asked, 4 * asked_whole);
}

/// What is hidden is asked for with points around all positions, and is not listed.
TEST(TriangleLists, HiddenLightsAreLeftOut) {
  const std::vector<StillTriangle> triangles{triangle_of({0, 0, 0}, {0, 0, 8}, {8, 0, 0})};
  RandomDoubles random(9);
  const std::vector<lamp::shared::Light> lights = random_lights(random, 100, 8.0, 6.0);
  TriangleListsInfo info{.triangles = triangles, .lights = lights, .slack_m = 0.01F};
  // A wall at x = 2, without end: lights on this side do not see the other.
  info.hides = [&](std::uint32_t light, std::span<const lamp::DVec3> hull) {
    if (lights[light].position.x > 2.0F) return false;
    return std::ranges::all_of(hull, [](const lamp::DVec3& at) { return at.x > 2.0; });
  };
  const TriangleLists lists = made(info);
  EXPECT_GT(lists.stats.hidden, 0U);
  for (int i = 0; i < 2000; ++i) {
    const glm::vec3 position(point_on(random, triangles[0]));
    const std::vector<std::uint32_t> found = lights_at(lists, 0, lamp::Vec3(position));
    for (std::uint32_t light = 0; light < lights.size(); ++light) {
      const bool sees = lights[light].position.x > 2.0F || position.x <= 2.0F;
      if (!sees || lamp::reach(lights[light], glm::dvec3(position)) != lamp::Reach::inside) continue;
      EXPECT_TRUE(std::ranges::binary_search(found, light));
    }
  }
}

TEST(TriangleLists, OddInputIsDefined) {
  const std::vector<lamp::shared::Light> none;
  const std::vector<StillTriangle> no_triangles;
  EXPECT_EQ(made({.triangles = no_triangles, .lights = none}).bytes(), 8U);

  RandomDoubles random(10);
  std::vector<lamp::shared::Light> lights = random_lights(random, 64, 5.0, 2.0);
  lights[0].range = 0.0F;
  lights[2].range = std::numeric_limits<float>::infinity();
  lights[3].range = std::numeric_limits<float>::infinity();  // a spot
  EXPECT_EQ(made({.triangles = no_triangles, .lights = lights}).bytes(), 8U);

  const glm::dvec3 a(1.0, 2.0, 3.0);
  const std::vector<StillTriangle> triangles{
      triangle_of(a, a, a),                                            // a point
      triangle_of({-5, 0, 0}, {0, 0, 0}, {5, 0, 0}),                   // a line
      triangle_of({-1e15, 0, -1e15}, {1e15, 0, -1e15}, {0, 0, 1e15}),  // enormous
      triangle_of({-1e4, -1e4, 1}, {1e4, -1e4, 1}, {0, 1e4, 1}),       // large
      triangle_of({0, 0, 0}, {1e-20, 0, 0}, {0, 1e-20, 0})};           // tiny
  const TriangleListsInfo info{.triangles = triangles, .lights = lights};
  const TriangleLists lists = made(info);
  for (int i = 0; i < 2000; ++i)
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      glm::dvec3 at = point_on(random, triangles[t]);
      if (t == 2 || t == 3) at = {random.in(-7, 7), t == 3 ? random.in(-7, 7) : 0.0, t == 3 ? 1.0 : random.in(-7, 7)};
      const glm::vec3 position(at);
      const std::vector<std::uint32_t> found = lights_at(lists, t, lamp::Vec3(position));
      for (std::uint32_t light = 0; light < lights.size(); ++light) {
        if (lamp::reach(lights[light], glm::dvec3(position)) != lamp::Reach::inside) continue;
        ASSERT_TRUE(std::ranges::binary_search(found, light)) << "light " << light << " at triangle " << t;
      }
      EXPECT_FALSE(std::ranges::binary_search(found, 0U)) << "reaches nothing";
    }
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_GE(lights_at(lists, 3, {nan, nan, nan}).size(), 1U);  // some patch's
}

TEST(TriangleLists, WrongInputIsNamed) {
  RandomDoubles random(11);
  std::vector<lamp::shared::Light> lights = random_lights(random, 4, 5.0, 2.0);
  std::vector<StillTriangle> triangles{triangle_of({0, 0, 0}, {1, 0, 0}, {0, 1, 0})};
  const auto text = [&](TriangleListsInfo info) {
    info.triangles = triangles;
    info.lights = lights;
    const auto lists = lamp::make_triangle_lists(info);
    return lists.ok() ? std::string() : lists.error().text();
  };
  EXPECT_EQ(text({.slack_m = -1.0F}), "slack_m: must be >= 0 m and finite, got -1");
  EXPECT_EQ(text({.slack_m = std::numeric_limits<float>::infinity()}), "slack_m: must be >= 0 m and finite, got inf");
  EXPECT_EQ(text({.patch = 0.0F}), "patch: must be > 0, got 0");
  EXPECT_EQ(text({.budget_bytes = 0}), "budget_bytes: must be > 0, got 0");
  lights[3].range = -1.0F;
  EXPECT_EQ(text({}), "light 3: range must be >= 0 m, got -1");
  lights[3].range = 1.0F;
  lights[1].direction = {0, 0, 0};
  EXPECT_EQ(text({}), "light 1: direction must have a length of 1, got (0, 0, 0)");
  lights[1].direction = {0, 0, 1};
  triangles[0].normal_tilt = -0.5F;
  EXPECT_EQ(text({}), "triangle 0: normal_tilt must be >= 0 radians, got -0.5");
  triangles[0].normal_tilt = 0.0F;
  lights[1].direction = {0, 0, 0};
  triangles[0].corners[1].x = 2e15;
  EXPECT_EQ(text({}), "triangle 0: corners must be finite and at most 1e15 m from the origin, got (2e+15, 0, 0)");
}

TEST(TriangleLists, SlackOfARaster) {
  EXPECT_FLOAT_EQ(lamp::raster_slack(100.0F, 0.001F, 8), 4.0F * std::sqrt(0.5F) * 0.1F / 256.0F);
}

}  // namespace
