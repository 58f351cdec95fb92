// Occlusion worked out ahead: what it says is hidden, random points and rays in double precision try to find lit. And
// it must hide a good deal: what a person would say is hidden, and most of it in a building.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/occlusion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

#include "oracle/occluders.h"
#include "random.h"
#include "scene/builtin.h"
#include "scene/still_triangles.h"

namespace {

using lamp::DVec3;
using lamp::OccluderTriangle;
using lamp::OcclusionMap;
using lamp::StillOccluders;
using lamp::Vec3;

constexpr double INF = std::numeric_limits<double>::infinity();

using lamp::test::RandomDoubles;

using TriangleCorners = std::vector<OccluderTriangle>;

lamp::Occluders rays_against(const TriangleCorners& triangles) {
  std::vector<lamp::Triangle> all;
  for (const OccluderTriangle& t : triangles) all.push_back({{glm::dvec3(t[0]), glm::dvec3(t[1]), glm::dvec3(t[2])}});
  return lamp::Occluders(std::move(all));
}

void add_quad(TriangleCorners& to, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
  to.push_back({DVec3(a), DVec3(b), DVec3(c)});
  to.push_back({DVec3(a), DVec3(c), DVec3(d)});
}

/// A wall in the plane z = `z`, of n x n squares.
TriangleCorners wall(double half, double z, int n = 1) {
  TriangleCorners triangles;
  const auto at = [&](int i) { return half * (2.0 * i / n - 1.0); };
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x)
      add_quad(triangles, {at(x), at(y), z}, {at(x + 1), at(y), z}, {at(x + 1), at(y + 1), z}, {at(x), at(y + 1), z});
  return triangles;
}

/// Random sizes, slopes and places; some in planes of the axes, some meshes of neighbours that share corners.
TriangleCorners random_triangles(RandomDoubles& random, double far_away) {
  TriangleCorners triangles;
  for (int i = 0; i < 60; ++i) {
    const glm::dvec3 at = random.vector(8.0) + far_away;
    glm::dvec3 flat(1.0);
    if (i % 3 == 0) flat[i % 9 / 3] = 0.0;
    const double size = i % 5 == 0 ? 9.0 : 3.0;
    const glm::dvec3 u = flat * random.vector(size);
    const glm::dvec3 v = flat * random.vector(size);
    if (i % 2 == 0) {
      add_quad(triangles, at, at + u, at + u + v, at + v);
      add_quad(triangles, at + u, at + u + u, at + u + u + v, at + u + v);
    } else {
      triangles.push_back({DVec3(at), DVec3(at + u), DVec3(at + v)});
    }
  }
  return triangles;
}

/// A point of the hull, by weights that are often at a corner or an edge.
glm::dvec3 point_of(RandomDoubles& random, const std::vector<DVec3>& corners) {
  double sum = 0.0;
  glm::dvec3 point(0.0);
  for (const DVec3& corner : corners) {
    const double weight = random.in(0.0, 1.0) < 0.4 ? 0.0 : -std::log(random.in(1e-12, 1.0));
    sum += weight;
    point += weight * glm::dvec3(corner);
  }
  return sum > 0.0 ? point / sum : glm::dvec3(corners[0]);
}

std::vector<DVec3> box_corners(const glm::dvec3& min, const glm::dvec3& max) {
  std::vector<DVec3> corners;
  for (int i = 0; i < 8; ++i) corners.emplace_back(i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z);
  return corners;
}

/// Of so many points of a hull that is said to be hidden, those that a ray reaches.
int reached(RandomDoubles& random, const lamp::Occluders& rays, const glm::dvec3& light, const std::vector<DVec3>& hull,
            int points) {
  int lit = 0;
  for (int i = 0; i < points; ++i) {
    const glm::dvec3 point = point_of(random, hull);
    // What stops it lies well before the point.
    if (!rays.any_hit({.from = light, .to = point, .first = 0.0, .last = 1.0 - 0.5 * OcclusionMap::HIDDEN_BEYOND}))
      ++lit;
  }
  return lit;
}

TEST(OcclusionMap, NothingThatItHidesIsLit) {
  RandomDoubles random(31);
  int hidden = 0;
  for (int round = 0; round < 300; ++round) {
    const double far_away = round % 4 == 3 ? 1e4 : 0.0;
    const TriangleCorners triangles = random_triangles(random, far_away);
    const StillOccluders occluders(triangles);
    const lamp::Occluders rays = rays_against(triangles);
    const Vec3 light(glm::vec3(random.vector(8.0) + far_away));
    const std::uint32_t resolution = std::array{1U, 7U, 32U, 64U}[round % 4];
    const OcclusionMap map = OcclusionMap::of(occluders, light, round % 2 == 0 ? 1e30F : 12.0F, resolution);
    for (int i = 0; i < 400; ++i) {
      const glm::dvec3 at = random.vector(14.0) + far_away;
      const double size = random.in(0.0, 1.0) < 0.5 ? 0.3 : 3.0;
      std::vector<DVec3> hull = box_corners(at, at + size * random.in(0.0, 1.0));
      if (i % 2 == 0) hull = {DVec3(at), DVec3(at + random.vector(size)), DVec3(at + random.vector(size))};
      if (!map.hides(hull)) continue;
      ++hidden;
      ASSERT_EQ(reached(random, rays, glm::dvec3(light), hull, 60), 0) << "round " << round << ", hull " << i;
    }
  }
  EXPECT_GT(hidden, 5000);
}

TEST(OcclusionMap, HidesWhatLiesBehindAWallAndNothingElse) {
  const StillOccluders occluders(wall(10.0, 1.0));
  const OcclusionMap map = OcclusionMap::of(occluders, {0, 0, 0}, 100.0F, 32);
  const auto hides = [&](const glm::dvec3& min, const glm::dvec3& max) {
    EXPECT_EQ(map.hides(DVec3(min), DVec3(max)), map.hides(box_corners(min, max)));
    return map.hides(DVec3(min), DVec3(max));
  };
  EXPECT_TRUE(hides({-1, -1, 1.01}, {1, 1, 2}));
  EXPECT_TRUE(hides({-1, -1, 1.001}, {1, 1, 80}));
  EXPECT_TRUE(hides({3, 3, 1.01}, {4, 4, 2})) << "across the edges of the cube";
  EXPECT_TRUE(hides({-8, -8, 1.01}, {8, 8, 1.1})) << "in five of its faces";
  EXPECT_FALSE(hides({-1, -1, 0.99}, {1, 1, 2})) << "the wall passes through it";
  EXPECT_FALSE(hides({-1, -1, -2}, {1, 1, -1})) << "on the other side";
  EXPECT_FALSE(hides({-1, -1, -2}, {1, 1, 3})) << "around the light";
  EXPECT_FALSE(hides({10, -1, 1.01}, {11, 1, 1.02})) << "beside the wall";
  EXPECT_FALSE(hides({20, -1, 1.01}, {21, 1, 5}));
  EXPECT_FALSE(hides({0, 0, 1}, {0, 0, 1})) << "a point of the wall itself";
  EXPECT_TRUE(hides({0, 0, 1.001}, {0, 0, 1.001}));
}

TEST(OcclusionMap, ATriangleOnAWallIsNotHiddenByIt) {
  for (const double far_away : {0.0, 300.0}) {
    TriangleCorners triangles;
    add_quad(triangles, glm::dvec3(-9, 1, -7) + far_away, glm::dvec3(9, 1.5, -7) + far_away,
             glm::dvec3(9, 2.5, 7) + far_away, glm::dvec3(-9, 2, 7) + far_away);
    const OcclusionMap map =
        OcclusionMap::of(StillOccluders(triangles), Vec3(glm::vec3(0.2F, -0.3F, 0.1F) + float(far_away)), 50.0F, 64);
    const auto of = [&](double lifted) {
      std::vector<DVec3> corners;
      for (const DVec3& c : triangles[0])
        corners.emplace_back(c.x * 0.5 + far_away * 0.5, c.y + lifted, c.z * 0.5 + far_away * 0.5);
      return corners;
    };
    EXPECT_FALSE(map.hides(std::span<const DVec3>(triangles[0])));
    EXPECT_FALSE(map.hides(of(-1.0)));
    EXPECT_TRUE(map.hides(of(2.0)));
  }
}

TEST(StillOccluders, MergeWhatLiesInAPlane) {
  EXPECT_EQ(StillOccluders(wall(10.0, 1.0)).polygons(), 1U);
  EXPECT_EQ(StillOccluders(wall(10.0, 1.0, 16)).polygons(), 1U);
  TriangleCorners bent = wall(10.0, 1.0);
  const double c = std::sqrt(0.5);
  for (OccluderTriangle& t : bent)
    for (DVec3& p : t) p = {c * p.x - c * p.z, p.y, c * p.x + c * p.z};
  EXPECT_EQ(StillOccluders(bent).polygons(), 1U) << "turned";
  TriangleCorners corner = wall(1.0, 1.0);
  add_quad(corner, {1, -1, 1}, {1, 1, 1}, {1, 1, -1}, {1, -1, -1});
  EXPECT_EQ(StillOccluders(corner).polygons(), 2U) << "not around a corner";
  TriangleCorners angle = wall(1.0, 1.0);
  add_quad(angle, {1, -1, 1}, {2, -1, 1}, {2, 0.5, 1}, {1, 0.5, 1});
  EXPECT_GE(StillOccluders(angle).polygons(), 2U) << "an L is not convex";
  const TriangleCorners apart{{DVec3(0, 0, 0), DVec3(1, 0, 0), DVec3(0, 1, 0)},
                              {DVec3(1, 0, 1e-3), DVec3(1, 1, 0), DVec3(0, 1, 0)}};
  EXPECT_EQ(StillOccluders(apart).polygons(), 2U);
}

TEST(StillOccluders, BadTrianglesHideNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const TriangleCorners bad{{DVec3(0, 0, 0), DVec3(1, 0, 0), DVec3(2, 0, 0)},
                            {DVec3(0, 0, 0), DVec3(0, 0, 0), DVec3(0, 0, 0)},
                            {DVec3(0, 0, 0), DVec3(INF, 0, 0), DVec3(0, 1, 0)},
                            {DVec3(0, nan, 0), DVec3(1, 0, 0), DVec3(0, 1, 0)}};
  const StillOccluders occluders(bad);
  EXPECT_EQ(occluders.polygons(), 0U);
  EXPECT_EQ(occluders.left_out(), 4U);
  for (const StillOccluders& none : {StillOccluders({}), StillOccluders(bad)}) {
    const OcclusionMap map = OcclusionMap::of(none, {0.2F, 0.2F, -1.0F}, INFINITY, 8);
    EXPECT_FALSE(map.hides_anything());
    EXPECT_FALSE(map.hides({0.2, 0.2, 1.0}, {0.3, 0.3, 2.0}));
  }
  // Enormous ones hide as others do; what is asked of nowhere is not hidden.
  const StillOccluders enormous(wall(1e7, 1.0));
  const OcclusionMap map = OcclusionMap::of(enormous, {0, 0, 0}, INFINITY, 16);
  EXPECT_TRUE(map.hides({-1, -1, 2}, {1, 1, 3}));
  EXPECT_FALSE(map.hides({-1, -1, 2}, {1, 1, INF}));
  EXPECT_FALSE(map.hides({-1, nan, 2}, {1, 1, 3}));
  EXPECT_FALSE(map.hides(std::span<const DVec3>{}));
  const float nowhere = std::numeric_limits<float>::infinity();
  EXPECT_FALSE(OcclusionMap::of(enormous, {nowhere, 0, 0}, nowhere, 16).hides_anything());
}

/// In a building, of boxes that no ray reaches, how many are known to be hidden.
TEST(OcclusionMap, HidesMostOfTheRoomsBehindWalls) {
  const auto built_in = lamp::app::builtin_scenes();
  const lamp::app::Scene scene = std::ranges::find(built_in, "corridor", &lamp::app::BuiltinScene::name)->make();
  const TriangleCorners triangles = lamp::app::still_triangles(scene);
  const StillOccluders occluders(triangles);
  const lamp::Occluders rays = rays_against(triangles);
  EXPECT_LT(occluders.polygons(), triangles.size() * 3 / 4);
  RandomDoubles random(5);
  int dark = 0;
  int hidden = 0;
  for (int l = 0; l < 40; ++l) {
    const glm::dvec3 light(glm::vec3(random.in(1.0, 29.0), random.in(0.3, 2.5), random.in(-6.0, 6.0)));
    const OcclusionMap map = OcclusionMap::of(occluders, Vec3(glm::vec3(light)), 12.0F, 64);
    for (int i = 0; i < 200; ++i) {
      const glm::dvec3 low(random.in(0.0, 30.0), random.in(0.0, 2.5), random.in(-7.0, 7.0));
      const std::vector<DVec3> box = box_corners(low, low + 0.25);
      if (glm::distance(low, light) > 11.0) continue;
      const bool is_hidden = map.hides(box);
      const int lit = reached(random, rays, light, box, 40);
      ASSERT_TRUE(!is_hidden || lit == 0) << "light " << l << ", box " << i;
      dark += lit == 0 ? 1 : 0;
      hidden += is_hidden ? 1 : 0;
    }
  }
  RecordProperty("dark", dark);
  RecordProperty("hidden", hidden);
  EXPECT_GT(dark, 2000);
  EXPECT_GT(hidden, dark * 9 / 10) << dark;
}

}  // namespace
