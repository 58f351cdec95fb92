// The tree of lights that stand still: no light missed at any point that it reaches and sees, whatever the lights, the
// budget and the changes.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/world_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <utility>
#include <vector>

#include "lamplight/shared/world_tree.h"
#include "oracle/occluders.h"
#include "oracle/points.h"
#include "random.h"
#include "scene/builtin.h"
#include "scene/open_air.h"
#include "scene/place_lights.h"
#include "scene/random_points.h"
#include "scene/still_triangles.h"
#include "world_lights.h"

namespace {

using lamp::Light;
using lamp::LightType;
using lamp::OccluderTriangle;
using lamp::StillOccluders;
using lamp::WorldTree;
using lamp::WorldTreeInfo;

constexpr float INF = std::numeric_limits<float>::infinity();
constexpr std::uint64_t PLENTY = 64ULL << 20;

using lamp::test::lights_around;
using lamp::test::Points;
using lamp::test::points_in;
using PackedLights = std::vector<lamp::shared::Light>;

WorldTree built(const WorldTreeInfo& info) {
  auto tree = WorldTree::build(info);
  EXPECT_TRUE(tree.ok()) << tree.error().text();
  return std::move(tree.value());
}

struct Found {
  std::uint64_t walked = 0;
  std::uint64_t useful = 0;
  [[nodiscard]] double waste() const { return static_cast<double>(walked) / static_cast<double>(useful); }
};

/// Whether a ray from the light meets nothing well before the point.
bool is_seen(const lamp::Occluders& rays, const glm::dvec3& light, const glm::dvec3& point) {
  return !rays.any_hit({.from = light, .to = point, .first = 0.0, .last = 1.0 - 0.5e-4});
}

/// Expects every light that reaches a point and is seen, once, ascending.
Found expect_no_miss(const WorldTree& tree, const Points& points, const lamp::Occluders* rays = nullptr) {
  const lamp::PointTruth truth = lamp::truth_at(points, tree.lights());
  Found found;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::vector<std::uint32_t> walked = tree.lights_at(lamp::Vec3(points[i]));
    EXPECT_EQ(std::ranges::adjacent_find(walked, std::ranges::greater_equal{}), walked.end()) << "they ascend";
    found.walked += walked.size();
    for (const std::uint32_t light : truth.of(i)) {
      const glm::dvec3 position(glm::vec3(tree.lights()[light].position));
      if (rays != nullptr && !is_seen(*rays, position, glm::dvec3(points[i]))) continue;
      ++found.useful;
      EXPECT_TRUE(std::ranges::binary_search(walked, light))
          << "light " << light << " at " << points[i].x << " " << points[i].y << " " << points[i].z;
    }
  }
  return found;
}

struct Building {
  lamp::app::Scene scene;
  std::vector<OccluderTriangle> triangles;
  std::shared_ptr<const StillOccluders> occluders;
  lamp::Occluders rays;
  PackedLights lights;
  Points points;
};

lamp::Occluders rays_against(const std::vector<OccluderTriangle>& triangles) {
  std::vector<lamp::Triangle> all;
  for (const OccluderTriangle& t : triangles) all.push_back({{glm::dvec3(t[0]), glm::dvec3(t[1]), glm::dvec3(t[2])}});
  return lamp::Occluders(std::move(all));
}

const Building& corridor() {
  static const Building building = [] {
    const auto scenes = lamp::app::builtin_scenes();
    lamp::app::Scene scene = std::ranges::find(scenes, "corridor", &lamp::app::BuiltinScene::name)->make();
    const lamp::app::OpenAir air = lamp::app::find_open_air(scene);
    std::vector<OccluderTriangle> triangles = lamp::app::still_triangles(scene);
    const lamp::app::PointSource source(scene, air, {15.0F, 1.6F, 0.0F});
    Points points;
    for (const lamp::app::PointKind kind : lamp::app::POINT_KINDS)
      for (const glm::vec3& point : source.draw(kind, 600, 1)) points.push_back(point);
    return Building{.scene = std::move(scene),
                    .triangles = triangles,
                    .occluders = std::make_shared<StillOccluders>(triangles),
                    .rays = rays_against(triangles),
                    .lights = lamp::pack(lamp::app::place_lights(air, {.count = 300})),
                    .points = points};
  }();
  return building;
}

TEST(WorldTree, MissesNoLightAndWalksFew) {
  const WorldTree tree = built({.lights = lights_around({}, 10.0F, 1.0F, 4.0F, 500)});
  const Found found = expect_no_miss(tree, points_in(1, 4000, glm::vec3(-15.0F), glm::vec3(15.0F)));
  EXPECT_LT(found.waste(), 1.35);
  EXPECT_GT(found.useful, 3000U);
  EXPECT_EQ(tree.counts().coarser, 1.0);
  EXPECT_EQ(tree.counts().detail, 16.0);
  EXPECT_LE(tree.words().size() * 4, PLENTY);
}

TEST(WorldTree, LeavesOutWhatWallsHide) {
  const Building& b = corridor();
  const WorldTree seen = built({.lights = b.lights, .occluders = b.occluders});
  const Found found = expect_no_miss(seen, b.points, &b.rays);
  EXPECT_LT(found.waste(), 1.75) << "of lights that a point sees";
  const Found without = expect_no_miss(built({.lights = b.lights}), b.points);
  EXPECT_LT(found.walked * 10, without.walked * 8);
}

/// As those of half floats are.
TEST(WorldTree, DirectionsNeedNotBeOfLengthOneToTheLastDigit) {
  std::vector<lamp::Light> spots;
  lamp::test::Random random(3);
  for (int i = 0; i < 200; ++i)
    spots.push_back({.type = lamp::LightType::spot,
                     .position = random.vector(8.0F),
                     .range = random.in(2.0F, 6.0F),
                     .direction = random.direction(),
                     .outer_angle = random.in(0.01F, 0.1F)});
  PackedLights lights = lamp::pack(spots);
  Points points;
  for (int i = 0; i < 20'000; ++i) {  // near the cones' sides
    const lamp::Light& spot = spots[random.below(200)];
    const glm::vec3 axis(spot.direction);
    const glm::vec3 aside = glm::normalize(glm::cross(axis, random.direction()));
    const float along = random.in(0.0F, spot.range);
    points.push_back(glm::vec3(spot.position) + along * (axis + aside * std::tan(spot.outer_angle) * 0.999F));
  }
  const lamp::PointTruth truth = lamp::truth_at(points, lights);
  for (const float length : {0.9996F, 1.0004F}) {
    PackedLights rounded = lights;
    for (lamp::shared::Light& light : rounded) light.direction = length * glm::vec3(light.direction);
    const WorldTree tree = built({.lights = rounded});
    std::size_t missed = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::vector<std::uint32_t> walked = tree.lights_at(lamp::Vec3(points[i]));
      for (const std::uint32_t light : truth.of(i)) missed += std::ranges::binary_search(walked, light) ? 0 : 1;
    }
    EXPECT_EQ(missed, 0U) << length;
  }
}

TEST(WorldTree, IsTheSameHoweverManyThreadsBuildIt) {
  const Building& b = corridor();
  const WorldTreeInfo one{.lights = std::span(b.lights).first(100), .occluders = b.occluders, .threads = 1};
  WorldTreeInfo three = one;
  three.threads = 3;
  EXPECT_TRUE(std::ranges::equal(built(one).words(), built(three).words()));
}

TEST(WorldTree, KeepsToItsBudgetAndSaysWhatThatCosts) {
  const Building& b = corridor();
  double waste = 0.0;
  double coarser = 0.0;
  for (const std::uint64_t budget : {PLENTY, std::uint64_t{1} << 20, std::uint64_t{1} << 17, std::uint64_t{1} << 13}) {
    const WorldTree tree = built({.lights = b.lights, .occluders = b.occluders, .budget = budget});
    EXPECT_LE(tree.words().size() * 4, budget);
    EXPECT_FALSE(tree.counts().every_light);
    const Found found = expect_no_miss(tree, b.points, &b.rays);
    EXPECT_GT(found.waste(), waste) << budget;
    EXPECT_GE(tree.counts().coarser, coarser) << budget;
    waste = found.waste();
    coarser = tree.counts().coarser;
  }
  EXPECT_GT(coarser, 1.1);
  EXPECT_GT(waste, 2.5);
  for (const std::uint64_t budget : {0, 4, 100}) {
    const WorldTree none = built({.lights = b.lights, .budget = budget});
    EXPECT_TRUE(none.counts().every_light);
    EXPECT_EQ(none.lights_at({1, 2, 3}).size(), b.lights.size());
  }
}

TEST(WorldTree, KnowsLightsOfEveryRange) {
  const lamp::test::LightsAndPoints every = lamp::test::lights_of_every_range();
  Points points{{INF, 0, 0}, {0, std::nanf(""), 0}, {0, 0, -1e30F}};
  points.insert(points.end(), every.points.begin(), every.points.end());
  const WorldTree tree = built({.lights = lamp::pack(every.lights)});
  EXPECT_GT(expect_no_miss(tree, points).useful, 3 * points.size());
  for (const glm::vec3& nowhere : {points[0], points[1]}) {
    const std::vector<std::uint32_t> walked = tree.lights_at(lamp::Vec3(nowhere));
    for (const std::uint32_t infinite : {81U, 82U, 83U}) EXPECT_TRUE(std::ranges::binary_search(walked, infinite));
  }
}

TEST(WorldTree, KnowsLightsAnywhere) {
  const Points near = points_in(1, 1000, glm::vec3(-20.0F), glm::vec3(20.0F));
  for (const float far_away : {1e5F, 1e7F}) {
    Points there = near;
    for (glm::vec3& point : there) point += far_away;
    EXPECT_GT(
        expect_no_miss(built({.lights = lights_around(glm::vec3(far_away), 20.0F, 1.0F, 8.0F, 200)}), there).useful,
        500U);
  }
  std::vector<Light> apart;
  Points at;
  for (int i = 0; i < 60; ++i) {
    const glm::vec3 place(std::ldexp(1.0F, i - 20), std::ldexp(-1.0F, i - 30), 5.0F);
    apart.push_back({.position = place, .range = 1.0F});
    at.push_back(place + 0.25F);
  }
  expect_no_miss(built({.lights = lamp::pack(apart)}), at);
  const PackedLights one_place(1000, lamp::pack(Light{.position = {1, 2, 3}, .range = 2.0F}));
  const WorldTree pile = built({.lights = one_place});
  EXPECT_EQ(pile.lights_at({1, 2, 3}).size(), 1000U);
  EXPECT_EQ(pile.lights_at({4, 2, 3}).size(), 0U);
}

/// At the ends of spheres along the axes, and along the sides of cones, where a cell beside is dark: a position is
/// found there that rounding moves, by the size of its coordinates and by how far its eye is away.
TEST(WorldTree, KnowsWhatLightsJustReachWhereRoundingMovesIt) {
  for (const auto& [far_away, eyes_m] :
       {std::pair(0.0F, 0.0F), {1e4F, 0.0F}, {1e5F, 0.0F}, {0.0F, 1e4F}, {1e3F, 1e5F}}) {
    lamp::test::Random random(9);
    std::vector<Light> lights;
    Points ends;
    Points ways;
    for (int i = 0; i < 600; ++i) {
      Light light{.position = random.vector(20.0F) + far_away, .range = random.in(1.0F, 4.0F)};
      glm::vec3 way(0.0F);
      way[i % 3] = i % 2 == 0 ? 1.0F : -1.0F;
      ways.push_back(way);
      if (i % 4 == 3) {
        light.type = LightType::spot;
        light.outer_angle = random.in(0.05F, 1.5F);
        light.direction = random.direction();
        const glm::vec3 axis(light.direction);
        const glm::vec3 aside = glm::normalize(glm::cross(axis, random.direction()));
        const float angle = light.outer_angle * (1.0F - 1e-4F);
        way = 0.9F * (std::cos(angle) * axis + std::sin(angle) * aside);
        ways.back() = std::cos(angle) * aside - std::sin(angle) * axis;
      }
      ends.push_back(glm::vec3(light.position) + light.range * (1.0F - 3e-5F) * way);
      lights.push_back(light);
    }
    const PackedLights packed = lamp::pack(lights);
    const WorldTree tree = built({.lights = packed, .eyes_m = eyes_m});
    std::size_t inside = 0;
    for (std::uint32_t i = 0; i < ends.size(); ++i) {
      if (lamp::reach(packed[i], glm::dvec3(ends[i])) != lamp::Reach::inside) continue;  // by the rounding of its place
      ++inside;
      const glm::vec3 size = glm::abs(ends[i]);
      const glm::vec3 moved = ends[i] + ways[i] * (1e-6F * (size.x + size.y + size.z) + 4e-6F * eyes_m);
      EXPECT_TRUE(std::ranges::binary_search(tree.lights_at(lamp::Vec3(moved)), i)) << i << ", " << far_away;
    }
    EXPECT_GT(inside, 200U);
  }
}

TEST(WorldTree, IsEmptyWithoutLights) {
  for (const PackedLights& lights : {PackedLights{}, lamp::pack(std::vector<Light>(3, {.range = 0.0F}))}) {
    const WorldTree tree = built({.lights = lights, .occluders = corridor().occluders});
    EXPECT_EQ(tree.lights_at({0, 0, 0}).size(), 0U);
    EXPECT_EQ(tree.counts().entries, 0U);
    EXPECT_EQ(tree.counts().levels, 0U);
  }
  EXPECT_GT(built({.lights = lights_around({}, 10.0F, 1.0F, 4.0F, 50)}).counts().levels, 2U);
}

/// Changes, checks that only the words changed that it says, and that nothing is missed.
void change(WorldTree& tree, std::uint32_t id, const lamp::shared::Light& light) {
  const std::vector<std::uint32_t> before(tree.words().begin(), tree.words().end());
  const auto changed = tree.change(id, light);
  ASSERT_TRUE(changed.ok()) << changed.error().text();
  std::vector<std::uint32_t> followed(before);
  followed.resize(tree.words().size());
  for (const lamp::ChangedWords& part : changed.value())
    std::ranges::copy(tree.words().subspan(part.first, part.count),
                      followed.begin() + static_cast<std::ptrdiff_t>(part.first));
  EXPECT_TRUE(std::ranges::equal(followed, tree.words()));
  EXPECT_LE(tree.words().size(), tree.capacity());
}

TEST(WorldTree, FollowsAChangeOfALight) {
  const Building& b = corridor();
  WorldTree tree = built({.lights = std::span(b.lights).first(200), .occluders = b.occluders});
  lamp::shared::Light gone = b.lights[7];
  gone.range = 0.0F;
  change(tree, 7, gone);
  for (const glm::vec3& point : b.points)
    EXPECT_FALSE(std::ranges::binary_search(tree.lights_at(lamp::Vec3(point)), 7U));
  for (std::uint32_t i = 0; i < 10; ++i) change(tree, i, b.lights[200 + i]);
  change(tree, 200, b.lights[299]);
  EXPECT_EQ(tree.lights().size(), 201U);
  const auto infinite = lamp::pack(Light{.position = {15, 1, 0}});
  change(tree, 201, infinite);
  EXPECT_EQ(tree.lights_at({INF, 0, 0}), (std::vector<std::uint32_t>{201}));
  EXPECT_LT(expect_no_miss(tree, b.points, &b.rays).waste(), 2.5);
  EXPECT_FALSE(tree.change(300, gone).ok()) << "a gap";
}

/// Large ones are in finer leaves than their own cells.
TEST(WorldTree, ALightThatIsTakenAwayIsInNoLeaf) {
  PackedLights lights = lights_around({}, 10.0F, 0.5F, 1.0F, 200);
  const PackedLights large = lights_around({1, 2, 3}, 10.0F, 5.0F, 20.0F, 50);
  lights.insert(lights.end(), large.begin(), large.end());
  WorldTree tree = built({.lights = lights});
  for (std::uint32_t i = 200; i < 250; ++i) {
    lights[i].range = 0.0F;
    change(tree, i, lights[i]);
  }
  for (const glm::vec3& point : points_in(1, 20'000, glm::vec3(-30.0F), glm::vec3(30.0F)))
    for (const std::uint32_t light : tree.lights_at(lamp::Vec3(point))) EXPECT_LT(light, 200U);
}

/// Lists of the large ones are not copied for each place of the small ones.
TEST(WorldTree, TakesLittleMemoryForSmallLightsAmongLargeOnes) {
  const PackedLights small = lights_around({}, 10.0F, 0.5F, 1.0F, 200);
  const PackedLights large = lights_around({}, 10.0F, 15.0F, 20.0F, 50);
  PackedLights lights = small;
  lights.insert(lights.end(), large.begin(), large.end());
  const WorldTree tree = built({.lights = lights});
  EXPECT_LT(tree.counts().peak_entries,
            built({.lights = small}).counts().peak_entries + built({.lights = large}).counts().peak_entries);
  expect_no_miss(tree, points_in(1, 1000, glm::vec3(-30.0F), glm::vec3(30.0F)));
}

TEST(WorldTree, IsBuiltAnewWhenThereIsNoRoomForAChange) {
  const PackedLights lights = lights_around({}, 10.0F, 1.0F, 4.0F, 50);
  WorldTree tree = built({.lights = lights, .detail = 4});
  std::uint64_t most = 0;
  const PackedLights more = lights_around({3, 2, 1}, 10.0F, 1.0F, 4.0F, 400);
  for (std::uint32_t i = 0; i < more.size(); ++i) {
    change(tree, i % 100 == 0 ? static_cast<std::uint32_t>(tree.lights().size()) : i % 50, more[i]);
    most = std::max<std::uint64_t>(most, tree.words().size());
  }
  EXPECT_LT(tree.words().size(), most) << "never built anew";
  expect_no_miss(tree, points_in(1, 1000, glm::vec3(-15.0F), glm::vec3(15.0F)));
}

/// What rounding adds to a light counts as its range: cells by the range alone would be without number.
TEST(WorldTree, SmallLightsThatFarEyesSeeTakeFewCells) {
  for (const float eyes_m : {1e5F, 1e6F, 1e9F, 1e15F}) {
    const PackedLights lights = lights_around({}, 10.0F, 0.001F, 0.01F, 50);
    const WorldTree tree = built({.lights = lights, .eyes_m = eyes_m});
    EXPECT_LT(tree.counts().leaves, 50U * 5000) << eyes_m;
    expect_no_miss(tree, points_in(1, 1000, glm::vec3(-12.0F), glm::vec3(12.0F)));
  }
}

TEST(WorldTree, NamesWhatIsWrong) {
  PackedLights lights = lights_around({}, 1.0F, 1.0F, 2.0F, 4);
  lights[2].position.x = std::nanf("");
  EXPECT_EQ(WorldTree::build({.lights = lights}).error().source, "light 2");
  lights[2].position.x = 0.0F;
  lights[3].range = -1.0F;
  EXPECT_EQ(WorldTree::build({.lights = lights}).error().source, "light 3");
  lights[3].range = 1.0F;
  EXPECT_EQ(WorldTree::build({.lights = lights, .detail = 0}).error().source, "detail");
  EXPECT_EQ(WorldTree::build({.lights = lights, .detail = 65}).error().source, "detail");
  EXPECT_EQ(WorldTree::build({.lights = lights, .texels = 1025}).error().source, "texels");
  EXPECT_EQ(WorldTree::build({.lights = lights, .eyes_m = std::nanf("")}).error().source, "eyes_m");
  EXPECT_EQ(WorldTree::build({.lights = lights, .eyes_m = 1e16F}).error().source, "eyes_m");
  lights[2] = lamp::pack(Light{.type = LightType::spot, .range = 1.0F});
  EXPECT_TRUE(WorldTree::build({.lights = lights}).ok());
  lights[2].direction = {0, 0, 2};
  EXPECT_EQ(WorldTree::build({.lights = lights}).error().source, "light 2");
  lights[2].direction = {0, 0, 1};
  for (float* number : {&lights[2].cos_outer, &lights[2].sin_outer}) {
    const float right = std::exchange(*number, std::nanf(""));
    EXPECT_EQ(WorldTree::build({.lights = lights}).error().source, "light 2");
    *number = right;
  }
  lights[2].type = lamp::shared::LIGHT_POINT;
  lights[2].intensity.y = std::nanf("");
  EXPECT_EQ(WorldTree::build({.lights = lights}).error().source, "light 2");
  lights[2].intensity.y = 1.0F;
  EXPECT_EQ(built({.lights = lights, .threads = 100'000}).counts().entries, built({.lights = lights}).counts().entries);
  WorldTree tree = built({.lights = lights});
  lights[1].range = std::nanf("");
  EXPECT_EQ(tree.change(1, lights[1]).error().source, "light 1");
  EXPECT_EQ(tree.change(5, lights[0]).error().source, "light 5");
}

}  // namespace
