// Normals of instances, of every matrix that a scene may have: turned, sheared, mirrored, tiny, flat.
// SPDX-License-Identifier: Apache-2.0
#include "scene/normal_matrix.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "random.h"
#include "scene/still_surfaces.h"

namespace lamp::app {
namespace {

glm::mat4 turn_of(test::Random& random) {
  const float angle = random.in(-3.0F, 3.0F);
  return glm::rotate(glm::mat4(1.0F), angle, random.direction());
}

bool is_usable(const glm::vec3& normal) {
  const float square = glm::dot(normal, normal);  // of which shaders take the root
  return std::isfinite(square) && square > 1e-30F;
}

TEST(NormalMatrix, IsAMultipleOfTheTransposedInverse) {
  test::Random random(5);
  for (int i = 0; i < 200; ++i) {
    const glm::mat4 m(glm::mat3(random.vector(1.0F), random.vector(1.0F), random.vector(1.0F)));
    const glm::dmat3 inverse = glm::transpose(glm::inverse(glm::dmat3(m)));
    const glm::vec3 normal = random.vector(1.0F);
    const glm::dvec3 expected = glm::normalize(inverse * glm::dvec3(normal));
    EXPECT_LT(glm::distance(glm::dvec3(glm::normalize(normal_matrix(m) * normal)), expected), 1e-4);
  }
  EXPECT_EQ(normal_matrix(glm::mat4(1.0F)), glm::mat3(1.0F));
}

TEST(NormalMatrix, DoesNotDependOnTheSizeOfWhatIsPlaced) {
  test::Random random(5);
  for (const float size : {1e-38F, 1e-20F, 1e-15F, 1e-13F, 1e15F}) {
    const glm::mat4 turn = turn_of(random);
    const glm::vec3 normal = glm::normalize(random.vector(1.0F));
    const glm::vec3 placed = normal_matrix(glm::scale(turn, glm::vec3(-size, size, 3.0F * size))) * normal;
    ASSERT_TRUE(is_usable(placed)) << size;
    const glm::vec3 expected = glm::mat3(turn) * (normal / glm::vec3(-1.0F, 1.0F, 3.0F));
    EXPECT_LT(glm::distance(glm::normalize(placed), glm::normalize(expected)), 1e-5F) << size;
  }
}

/// The side of a triangle that is drawn is the one whose normal it shows, also where rounding alone says whether a
/// matrix mirrors: the loader turns the triangles round where it does.
TEST(NormalMatrix, OfAFlatMeshPointsOutOfItsFronts) {
  test::Random random(5);
  for (int i = 0; i < 500; ++i) {
    const glm::mat4 m = glm::scale(turn_of(random), glm::vec3(2.0F, i % 2 == 0 ? 1.0F : -1.0F, 0.0F)) * turn_of(random);
    const std::array<glm::vec3, 3> corners{random.vector(1.0F), random.vector(1.0F), random.vector(1.0F)};
    const glm::vec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    std::array<glm::dvec3, 3> at{};
    for (int k = 0; k < 3; ++k) at[k] = glm::dmat3(m) * glm::dvec3(corners[k]);
    const glm::dvec3 front = glm::cross(at[1] - at[0], at[2] - at[0]) * (is_mirroring(m) ? -1.0 : 1.0);
    const glm::dvec3 placed(normal_matrix(m) * normal);
    EXPECT_GT(glm::dot(glm::normalize(placed), glm::normalize(front)), 0.999) << i;
  }
}

TEST(NormalMatrix, OfAnyMatrixIsFiniteAndLeavesNoNormalZero) {
  test::Random random(5);
  const glm::vec3 scales[] = {{1, 1, 0},     {0, 1, 1},          {1, 0, 0},          {0, 0, 0},
                              {1, -1, 0},    {0, -1, 0},         {1, 1e-25F, 1},     {1e-38F, 0, 1},
                              {1e15F, 0, 1}, {1e15F, 1e-38F, 0}, {-1e15F, 1, 1e-20F}};
  for (const glm::vec3& scale : scales)
    for (int i = 0; i < 40; ++i) {
      const glm::mat4 flat = glm::scale(i < 7 ? glm::mat4(1.0F) : turn_of(random), scale);
      const glm::mat3 normals = normal_matrix(i < 14 ? flat : flat * turn_of(random));
      glm::vec3 normal = random.vector(1.0F);
      if (i % 7 < 6) {
        normal = glm::vec3(0.0F);
        normal[i % 3] = i % 7 < 3 ? 1.0F : -1.0F;
      }
      EXPECT_TRUE(is_usable(normals * normal)) << scale.x << ", " << scale.y << ", " << scale.z << ", " << i;
    }
}

TEST(NormalMatrix, ListsOfStillLightsAreMadeOfFlatMeshes) {
  Scene scene;
  scene.materials.resize(1);
  for (const glm::vec3& normal : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)})
    scene.vertices.push_back({.position = glm::vec3(1.0F) - normal, .normal = normal});
  scene.indices = {0, 1, 2};
  scene.meshes = {{.index_count = 3}};
  for (const glm::vec3& size : {glm::vec3(1, 1, 0), glm::vec3(0, 1, 0), glm::vec3(0.0F), glm::vec3(1e-30F)})
    scene.instances.push_back({.world_from_object = glm::scale(glm::mat4(1.0F), size)});
  TriangleListsInfo info;
  const std::vector<StillTriangle> triangles = still_surfaces(scene, /*painted=*/false);
  info.triangles = triangles;
  EXPECT_TRUE(make_triangle_lists(info)) << "normals are finite";
}

}  // namespace
}  // namespace lamp::app
