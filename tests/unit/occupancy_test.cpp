// The occupancy grid: no triangle is missed, and cells that a triangle does not touch stay free.
// SPDX-License-Identifier: Apache-2.0
#include "scene/occupancy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace {

using lamp::app::find_occupancy;
using lamp::app::Occupancy;
using lamp::app::Scene;

// Triangles of three corners each, in one mesh with a vertex offset, in one instance.
Scene scene_of(const std::vector<glm::vec3>& corners, const glm::mat4& world_from_object = glm::mat4(1.0F)) {
  Scene scene;
  scene.vertices.resize(1);
  for (const glm::vec3& corner : corners) {
    scene.indices.push_back(static_cast<std::uint32_t>(scene.vertices.size()) - 1);
    scene.vertices.push_back({.position = corner});
  }
  scene.meshes = {{.index_count = static_cast<std::uint32_t>(corners.size()), .vertex_offset = 1}};
  scene.instances = {{.world_from_object = world_from_object}};
  return scene;
}

glm::ivec3 cell_of(const Occupancy& grid, const glm::vec3& position) {
  return {glm::floor((position - grid.origin) / grid.cell_m)};
}

std::vector<glm::vec3> random_triangles(std::mt19937& engine, int count, float extent) {
  const auto unit = [&] { return static_cast<float>(engine() >> 8U) * 0x1p-24F; };
  std::vector<glm::vec3> corners;
  for (int i = 0; i < count; ++i) {
    const glm::vec3 center(10.0F * unit(), 6.0F * unit(), 8.0F * unit());
    for (int k = 0; k < 3; ++k) corners.push_back(center + extent * glm::vec3(unit(), unit(), unit()));
  }
  return corners;
}

TEST(Occupancy, HoldsEveryPointOfEveryTriangle) {
  std::mt19937 engine(5);
  for (const float extent : {0.02F, 0.5F, 12.0F}) {
    const std::vector<glm::vec3> corners = random_triangles(engine, 40, extent);
    const Occupancy grid = find_occupancy(scene_of(corners));
    for (std::size_t t = 0; t < corners.size(); t += 3) {
      for (int i = 0; i < 400; ++i) {
        const int row = i / 20;
        const float a = static_cast<float>(i % 20) / 19.0F;
        const float b = static_cast<float>(row) / 19.0F * (1.0F - a);
        const glm::vec3 point = corners[t] + a * (corners[t + 1] - corners[t]) + b * (corners[t + 2] - corners[t]);
        const glm::ivec3 cell = cell_of(grid, point);
        ASSERT_TRUE(grid.inner(cell));
        ASSERT_EQ(grid.solid[grid.index(cell)], 1) << "extent " << extent << ", triangle " << t / 3;
      }
    }
  }
}

// The exact test, cell by cell: clips the triangle by the cell, grown by a margin, and asks if anything is left.
bool touches(std::vector<glm::dvec3> polygon, const glm::dvec3& low, double side, double margin) {
  for (int axis = 0; axis < 3; ++axis) {  // most cells are far off
    const auto beyond = [&](const glm::dvec3& p) { return p[axis] > low[axis] + side + margin; };
    const auto before = [&](const glm::dvec3& p) { return p[axis] < low[axis] - margin; };
    if (std::ranges::all_of(polygon, beyond) || std::ranges::all_of(polygon, before)) return false;
  }
  for (int plane = 0; plane < 6; ++plane) {
    const int axis = plane / 2;
    const double sign = plane % 2 == 0 ? 1.0 : -1.0;
    const double limit = (plane % 2 == 0 ? low[axis] : -(low[axis] + side)) - margin;
    std::vector<glm::dvec3> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const glm::dvec3& a = polygon[i];
      const glm::dvec3& b = polygon[(i + 1) % polygon.size()];
      const double da = sign * a[axis] - limit;
      const double db = sign * b[axis] - limit;
      if (da >= 0.0) kept.push_back(a);
      if ((da >= 0.0) != (db >= 0.0)) kept.push_back(a + (b - a) * (da / (da - db)));
    }
    polygon = kept;
  }
  return !polygon.empty();
}

TEST(Occupancy, AgreesWithClippingEveryCell) {
  std::mt19937 engine(11);
  for (int round = 0; round < 3; ++round) {
    const std::vector<glm::vec3> corners = random_triangles(engine, 1, 9.0F);
    const Occupancy grid = find_occupancy(scene_of(corners));
    const std::vector<glm::dvec3> triangle(corners.begin(), corners.end());
    std::size_t solid = 0;
    for (std::size_t i = 0; i < grid.solid.size(); ++i) {
      const glm::ivec3 cell = grid.cell(i);
      if (!grid.inner(cell)) continue;
      const glm::dvec3 low = glm::dvec3(grid.origin) + double{grid.cell_m} * glm::dvec3(cell);
      solid += grid.solid[i];
      if (grid.solid[i] != 0) {
        ASSERT_TRUE(touches(triangle, low, grid.cell_m, 1e-3 * grid.cell_m)) << "round " << round << ", cell " << i;
      } else {
        ASSERT_FALSE(touches(triangle, low, grid.cell_m, -1e-5 * grid.cell_m)) << "round " << round << ", cell " << i;
      }
    }
    EXPECT_GT(solid, 100U);
  }
}

TEST(Occupancy, TriangleWithoutAnArea) {
  const Occupancy line = find_occupancy(scene_of({{0, 0, 0}, {4, 3, 2}, {2, 1.5F, 1}}));
  for (int i = 0; i <= 100; ++i) {
    const glm::vec3 point = static_cast<float>(i) / 100.0F * glm::vec3(4, 3, 2);
    EXPECT_EQ(line.solid[line.index(cell_of(line, point))], 1) << i;
  }
  const Occupancy point = find_occupancy(scene_of({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}));
  EXPECT_EQ(point.solid[point.index(cell_of(point, glm::vec3(1.0F)))], 1);
}

// Rounding leaves such triangles an area, and with it a plane, that have little to do with where they lie.
TEST(Occupancy, TriangleThatIsNearlyALine) {
  std::mt19937 engine(5);
  for (int round = 0; round < 30; ++round) {
    const std::vector<glm::vec3> t = random_triangles(engine, 1, 9.0F);
    const Occupancy line = find_occupancy(scene_of({t[0], t[1], glm::mix(t[0], t[1], 0.37F)}));
    int missed = 0;
    for (int i = 0; i <= 100; ++i)
      missed +=
          line.solid[line.index(cell_of(line, glm::mix(t[0], t[1], static_cast<float>(i) / 100.0F)))] != 1 ? 1 : 0;
    EXPECT_EQ(missed, 0) << round;
  }
}

TEST(Occupancy, SizesStayWithinTheirLimits) {
  const std::vector<glm::vec3> extents{{10, 10, 10},          {1000, 0, 1000}, {0, 500, 0},
                                       {1e-3F, 1e-3F, 1e-3F}, {1000, 3, 2},    {3e12F, 1e12F, 1e12F}};
  for (const glm::vec3& extent : extents) {
    const Occupancy grid = find_occupancy(scene_of({glm::vec3(0.0F), extent, 0.5F * extent}));
    EXPECT_LE(grid.solid.size(), 4U << 20U);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_GE(grid.size[axis], 10);
      EXPECT_LE(grid.size[axis], 290);
    }
    EXPECT_TRUE(grid.inner(cell_of(grid, glm::vec3(0.0F))));
    EXPECT_GT(grid.near_m, 2.9F * grid.cell_m);
  }
}

/// As pictures show it: a glTF file's mesh that is placed mirrored has its triangles turned round.
TEST(Occupancy, FacesWhereTheFrontIsAlsoOfWhatIsMirrored) {
  const std::vector<glm::vec3> corners{{0, 0, 0}, {1, 4, 0}, {3, 0, 2}};
  std::vector<glm::vec3> other_way = corners;
  for (glm::vec3& corner : other_way) corner.x *= -1.0F;
  const glm::mat4 mirrors(glm::vec4(-1, 0, 0, 0), glm::vec4(0, 1, 0, 0), glm::vec4(0, 0, 1, 0), glm::vec4(0, 0, 0, 1));
  EXPECT_EQ(find_occupancy(scene_of(other_way, mirrors)).facing, find_occupancy(scene_of(corners)).facing);
}

TEST(Occupancy, FollowsInstances) {
  const glm::mat4 moved(glm::vec4(0, 0, -2, 0), glm::vec4(0, 2, 0, 0), glm::vec4(2, 0, 0, 0), glm::vec4(100, 50, 7, 1));
  const Occupancy grid = find_occupancy(scene_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, moved));
  EXPECT_EQ(grid.solid[grid.index(cell_of(grid, {100, 50, 5}))], 1);
  EXPECT_EQ(grid.solid[grid.index(cell_of(grid, {100, 52, 7}))], 1);
  EXPECT_EQ(grid.solid[grid.index(cell_of(grid, {100, 52, 5}))], 0);
}

}  // namespace
