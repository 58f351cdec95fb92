// Rays against triangles: the hierarchy against a plain loop, and answers that are known.
// SPDX-License-Identifier: Apache-2.0
#include "oracle/occluders.h"

#include <gtest/gtest.h>

#include "random.h"

namespace {

using lamp::Occluders;
using lamp::Ray;
using lamp::Triangle;

using lamp::test::RandomDoubles;

TEST(Occluders, HierarchySkipsNothing) {
  RandomDoubles random(4);
  for (const double far_away : {0.0, 1e6}) {
    std::vector<Triangle> triangles;
    for (int i = 0; i < 700; ++i) {
      const glm::dvec3 at = random.vector(10.0) + far_away;
      // A third of them lie in a plane of the axes, where boxes have no thickness.
      glm::dvec3 flat(1.0);
      if (i % 3 == 0) flat[i % 9 / 3] = 0.0;
      triangles.push_back({{at, at + flat * random.vector(2.0), at + flat * random.vector(2.0)}});
    }
    const Occluders occluders(triangles, [](std::uint32_t triangle, double u, double) {
      return triangle % 5 != 0 || u < 0.5;  // some are half cut out
    });
    int hits = 0;
    for (int i = 0; i < 3000; ++i) {
      Ray ray{
          .from = random.vector(12.0) + far_away, .to = random.vector(12.0) + far_away, .first = 0.01, .last = 0.99};
      if (i % 4 == 0) ray.to[i % 3] = ray.from[i % 3];  // along a plane of the axes
      const auto by_loop = occluders.first_hit_of_all(ray);
      const auto by_hierarchy = occluders.first_hit(ray);
      ASSERT_EQ(by_loop.has_value(), by_hierarchy.has_value());
      ASSERT_EQ(by_loop.has_value(), occluders.any_hit(ray));
      if (!by_loop) continue;
      ++hits;
      EXPECT_EQ(by_loop->at, by_hierarchy->at);
      EXPECT_EQ(by_loop->triangle, by_hierarchy->triangle);
    }
    EXPECT_GT(hits, 300);
    EXPECT_LT(hits, 2700);
  }
}

/// The two sides of a flat mesh lie at one place, and one of them is drawn.
TEST(Occluders, OfTwoAtOnePlaceTheOneThatCountsIsMet) {
  const Triangle front{{glm::dvec3(0, 0, 0), {4, 0, 0}, {0, 4, 0}}};
  const Triangle back{{glm::dvec3(0, 0, 0), {0, 4, 0}, {4, 0, 0}}};
  const Triangle behind{{glm::dvec3(0, 0, -1), {4, 0, -1}, {0, 4, -1}}};
  const Occluders all({front, back, behind});
  for (const std::uint32_t counting : {0U, 1U, 2U}) {
    const auto hit = all.first_hit({.from = {1, 1, 3}, .to = {1, 1, -2}},
                                   [&](const lamp::Hit& met) { return met.triangle == counting; });
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->triangle, counting);
  }
  EXPECT_FALSE(all.first_hit({.from = {1, 1, 3}, .to = {1, 1, -2}}, [](const lamp::Hit&) { return false; }));
}

TEST(Occluders, KnownAnswers) {
  const Occluders wall(std::vector<Triangle>{{{glm::dvec3(0, 0, 0), {4, 0, 0}, {0, 4, 0}}}});
  const auto hit = wall.first_hit({.from = {1, 1, 3}, .to = {1, 1, -1}});
  ASSERT_TRUE(hit);
  EXPECT_DOUBLE_EQ(hit->at, 0.75);
  EXPECT_DOUBLE_EQ(hit->u, 0.25);
  EXPECT_DOUBLE_EQ(hit->v, 0.25);
  EXPECT_TRUE(wall.any_hit({.from = {1, 1, -1}, .to = {1, 1, 3}})) << "from behind, too";
  EXPECT_FALSE(wall.any_hit({.from = {1, 1, 3}, .to = {1, 1, 1}})) << "ends before it";
  EXPECT_FALSE(wall.any_hit({.from = {1, 1, 3}, .to = {1, 1, -1}, .last = 0.74}));
  EXPECT_FALSE(wall.any_hit({.from = {3, 3, 3}, .to = {3, 3, -1}})) << "beside it";
  EXPECT_FALSE(wall.any_hit({.from = {1, 1, 3}, .to = {1, 1, 3}})) << "nowhere";
  EXPECT_FALSE(Occluders(std::vector<Triangle>{}).any_hit({.from = {1, 1, 3}, .to = {1, 1, -1}}));
}

}  // namespace
