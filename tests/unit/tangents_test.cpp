// Normals and tangents that the loader makes: unit, perpendicular, and of the right hand even at mirrored seams.
// SPDX-License-Identifier: Apache-2.0
#include "scene/tangents.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using lamp::app::Triangles;
using lamp::app::Vertex;

Vertex vertex(glm::vec3 position, glm::vec2 uv) {
  Vertex made;
  made.position = position;
  made.normal = {0, 0, 1};
  made.uv[0] = uv;
  return made;
}

TEST(Tangents, SplitVerticesWhereTheTextureTurnsOver) {
  // Two triangles share the edge from (0,0) to (0,1); u grows away from it on both sides.
  Triangles triangles{
      {vertex({0, 0, 0}, {0, 0}), vertex({1, 0, 0}, {1, 0}), vertex({0, 1, 0}, {0, 1}), vertex({-1, 0, 0}, {1, 0})},
      {0, 1, 2, 0, 2, 3}};
  lamp::app::make_tangents(triangles, 0);
  EXPECT_EQ(triangles.vertices.size(), 6U) << "the two vertices of the seam twice";
  for (std::size_t i = 0; i < 6; ++i) {
    const float side = i < 3 ? 1.0F : -1.0F;
    EXPECT_EQ(triangles.vertices[triangles.indices[i]].tangent, glm::vec4(side, 0, 0, side)) << "corner " << i;
    EXPECT_GE(triangles.vertices[triangles.indices[i]].position.x * side, 0.0F) << "corner " << i;
  }
}

TEST(Tangents, DegenerateTrianglesGiveUnitVectorsAndSplitNothing) {
  Triangles triangles{{vertex({0, 0, 0}, {0, 0}), vertex({0, 0, 0}, {0, 0}), vertex({0, 1, 0}, {0.5F, 0.5F}),
                       vertex({1, 0, 0}, {-1, 0}), vertex({1, 1, 0}, {-1, 1})},
                      {0, 1, 2, 2, 3, 4}};
  lamp::app::make_tangents(triangles, 0);
  EXPECT_EQ(triangles.vertices.size(), 5U);
  for (const Vertex& made : triangles.vertices) {
    EXPECT_NEAR(glm::length(glm::vec3(made.tangent)), 1.0F, 1e-6F);
    EXPECT_NEAR(glm::dot(glm::vec3(made.tangent), made.normal), 0.0F, 1e-6F);
    EXPECT_EQ(std::abs(made.tangent.w), 1.0F);
  }
}

TEST(Tangents, FlatNormalsOfTrianglesWithoutAreaAreUnitVectors) {
  Triangles triangles{{vertex({1, 1, 1}, {0, 0})}, {0, 0, 0}};
  lamp::app::make_flat_normals(triangles);
  ASSERT_EQ(triangles.vertices.size(), 3U);
  for (const Vertex& made : triangles.vertices) EXPECT_EQ(glm::length(made.normal), 1.0F);
}

TEST(Tangents, RepairedNormalsAreTheMeanOfTheTriangles) {
  // A zero normal on the edge of a large triangle (facing z) and one of a quarter of its area (facing y).
  Triangles triangles{{vertex({0, 0, 0}, {}), vertex({2, 0, 0}, {}), vertex({0, 2, 0}, {}), vertex({0, 0, 1}, {}),
                       vertex({1, 0, 0}, {})},
                      {0, 1, 2, 0, 3, 4}};
  triangles.vertices[0].normal = glm::vec3(0.0F);
  EXPECT_EQ(lamp::app::repair_normals(triangles), 1U);
  const glm::vec3 expected = glm::normalize(glm::vec3(0, 1, 4));
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(triangles.vertices[0].normal[i], expected[i], 1e-6F);
}

}  // namespace
