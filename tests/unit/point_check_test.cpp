// Checks at points: the truth against the oracle light by light, and that what walks get wrong is found out.
// SPDX-License-Identifier: Apache-2.0
#include "render/point_check.h"

#include <gtest/gtest.h>

#include <limits>

#include "lamplight/light.h"
#include "oracle/occluders.h"
#include "render/mirror_check.h"
#include "render/still_check.h"
#include "world_lights.h"

namespace lamp::app {
namespace {

using Lists = std::vector<std::vector<std::uint32_t>>;

PointTruth expected_at(std::span<const glm::vec3> points, std::span<const shared::Light> lights) {
  PointTruth truth;
  for (const glm::vec3& point : points) {
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
      const Reach answer = reach(lights[i], glm::dvec3(point));
      if (answer == Reach::inside) truth.lights.push_back(i);
      if (answer == Reach::boundary) ++truth.boundary_pairs;
    }
    truth.offsets.push_back(truth.lights.size());
  }
  return truth;
}

void expect_same(const PointTruth& found, const PointTruth& expected) {
  EXPECT_EQ(found.offsets, expected.offsets);
  EXPECT_EQ(found.lights, expected.lights);
  EXPECT_EQ(found.boundary_pairs, expected.boundary_pairs);
}

TEST(PointTruth, EqualsTheOracleLightByLight) {
  std::vector<shared::Light> lights = test::lights_around({}, 10.0F, 1.0F, 4.0F, 300);
  lights[7].range = 0.0F;
  lights[8].range = std::numeric_limits<float>::infinity();
  const test::Points points = test::points_in(1, 700, glm::vec3(-12.0F), glm::vec3(12.0F));
  const PointTruth expected = expected_at(points, lights);
  EXPECT_GT(expected.lights.size(), 1000U);
  expect_same(truth_at(points, lights), expected);
  expect_same(truth_at({}, lights), {});
}

TEST(PointTruth, CountsTheBoundaryOnEitherSideOfIt) {
  std::vector<Light> lights;
  test::Points points;
  for (int i = 0; i < 20; ++i) {  // groups that a light reaches with its boundary alone
    lights.push_back({.position = {0.0F, 100.0F * static_cast<float>(i), 0.0F}, .range = 1.0F});
    points.insert(points.end(), 20, {i % 2 == 0 ? 1.000005F : 0.999995F, lights.back().position.y, 0.0F});
  }
  const PointTruth truth = truth_at(points, pack(lights));
  EXPECT_EQ(truth.boundary_pairs, points.size());
  EXPECT_TRUE(truth.lights.empty());
}

TEST(PointTruth, SeesUpToAPointsOwnSurface) {
  const Occluders wall(std::vector<Triangle>{{{glm::dvec3(-9, -9, 0), glm::dvec3(9, -9, 0), glm::dvec3(0, 9, 0)}}});
  const std::vector<shared::Light> lights =
      pack(std::vector<Light>{{.position = {0, 0, 1}, .range = 10.0F}, {.position = {0, 0, -1}, .range = 10.0F}});
  const test::Points points{{0, 0, 2}, {0, 0, -2}, {0, 0, 0}, {0, 20, 0}};
  const PointTruth seen = seen_at(truth_at(points, lights), points, lights, wall);
  EXPECT_EQ(seen.lights, (std::vector<std::uint32_t>{0, 1, 0, 1}));
  EXPECT_EQ(seen.offsets, (std::vector<std::size_t>{0, 1, 2, 4, 4}));
}

template <class Answer>
Answer answers(const Lists& lists) {
  Answer made;
  for (const auto& list : lists) {
    made.lights.insert(made.lights.end(), list.begin(), list.end());
    made.offsets.push_back(made.lights.size());
  }
  return made;
}

TEST(PointCheck, FindsOutWhatAWalkGetsWrong) {
  constexpr std::size_t LIGHTS = 5;
  const auto truth = answers<PointTruth>({{1, 4}, {}, {2}});
  constexpr WalkOrder ASCENDING = WalkOrder::ascending;
  constexpr WalkOrder ANY = WalkOrder::any;
  const std::vector<std::uint32_t> none{0, 0, 0};
  const struct {
    Lists walked;
    WalkOrder order;
    std::vector<std::uint32_t> ended;
    Verdict verdict;
    const char* reason;
  } cases[] = {
      {{{1, 4}, {}, {2}}, ASCENDING, none, Verdict::ok, ""},
      {{{0, 1, 4}, {3}, {2}}, ASCENDING, none, Verdict::ok, ""},
      {{{4, 1}, {}, {2}}, ANY, none, Verdict::ok, ""},
      {{{1, 4}, {}, {}},
       ASCENDING,
       none,
       Verdict::failed,
       "misses 1 pairs of point and light, the first: point 2, light 2"},
      {{{4}, {}, {}}, ANY, none, Verdict::failed, "misses 2 pairs of point and light, the first: point 0, light 1"},
      {{{4, 1}, {}, {2}}, ASCENDING, none, Verdict::failed, "the lights of 1 points do not ascend"},
      {{{1, 4}, {3, 3}, {2}}, ASCENDING, none, Verdict::failed, "the lights of 1 points do not ascend"},
      {{{4, 1, 4}, {}, {2}}, ANY, none, Verdict::failed, "the walks of 1 points name a light twice"},
      {{{1, 4, 5}, {}, {2}}, ASCENDING, none, Verdict::failed, "names 1 lights that there are not"},
      {{{1, 4}, {}, {}},
       ASCENDING,
       {0, 0, 1},
       Verdict::unchecked,
       "the device ended the walks of 1 points before their end"},
      {{{1}, {}, {}},
       ASCENDING,
       {0, 0, 1},
       Verdict::failed,
       "misses 1 pairs of point and light, the first: point 0, light 4"},
  };
  for (const auto& c : cases) {
    auto walked = answers<PointLights>(c.walked);
    walked.ended = c.ended;
    const PointFindings found = check_points(walked, truth, LIGHTS, c.order);
    EXPECT_EQ(found.reason(), c.reason);
    EXPECT_EQ(found.verdict(), c.verdict) << c.reason;
    PointFindings sum{.boundary_pairs = 3};  // of points before them
    sum.add(found, 10);
    EXPECT_EQ(sum.verdict(), c.verdict) << c.reason;
    EXPECT_EQ(sum.first_miss.point, found.missed != 0 ? 10 + found.first_miss.point : 0);
    sum.add({.useful = 1}, 13);
    EXPECT_EQ(sum.verdict(), c.verdict) << c.reason;
  }
}

TEST(MirrorFindings, FailByWhatRaysMeetAndByListsThere) {
  const PointFindings good{.useful = 1};
  const struct {
    MirrorFindings findings;
    Verdict verdict;
    std::string reason;
  } cases[] = {
      {{.lists = good}, Verdict::ok, ""},
      {{.wrong = 2, .first_wrong = "a", .lists = good},
       Verdict::failed,
       "2 mirror rays meet something else than the reference, the first: a"},
      {{.ended = 1}, Verdict::unchecked, "the device ended the search of 1 mirror rays before its end"},
      {{.wrong = 1, .ended = 1, .first_wrong = "b"},
       Verdict::failed,
       "1 mirror rays meet something else than the reference, the first: b"},
      {{.lists = PointFindings{.unordered = 1}},
       Verdict::failed,
       "at what mirror rays meet, the list the lights of 1 points do not ascend"},
      {{.ended = 1, .lists = PointFindings{.nowhere = 1}},
       Verdict::failed,
       "at what mirror rays meet, the list names 1 lights that there are not"},
  };
  for (const auto& c : cases) {
    EXPECT_EQ(c.findings.verdict(), c.verdict) << c.reason;
    EXPECT_EQ(c.findings.reason(), c.reason);
    for (const bool first : {false, true}) {  // of two pictures
      MirrorFindings both = first ? c.findings : MirrorFindings{.lists = good};
      both.add(first ? MirrorFindings{.lists = good} : c.findings);
      EXPECT_EQ(both.verdict(), c.verdict) << c.reason;
      EXPECT_EQ(both.reason(), c.reason);
    }
  }
}

TEST(StillFindings, FailByEachFaultAlone) {
  EXPECT_EQ(StillFindings{.points = 1}.verdict(), Verdict::ok);
  EXPECT_EQ((StillFindings{.points = 1, .missed = 1}.verdict()), Verdict::failed);
  EXPECT_EQ((StillFindings{.points = 1, .unordered = 1}.verdict()), Verdict::failed);
  EXPECT_EQ((StillFindings{.points = 1, .differing = 1}.verdict()), Verdict::failed);
}

}  // namespace
}  // namespace lamp::app
