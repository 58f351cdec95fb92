// Cofactors in double precision, and what stands in for them where they are 0.
// SPDX-License-Identifier: Apache-2.0
#include "scene/normal_matrix.h"

#include <algorithm>
#include <cmath>

namespace lamp::app {
namespace {

double largest(const glm::dmat3& m) {
  double most = 0.0;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) most = std::max(most, std::abs(m[i][k]));
  return most;
}

glm::dmat3 over(const glm::dmat3& m, double size) {
  return glm::dmat3(m[0] / size, m[1] / size, m[2] / size);  // each: 1 / size may be more than a double holds
}

}  // namespace

bool is_mirroring(const glm::mat4& world_from_object) { return glm::determinant(glm::dmat3(world_from_object)) < 0.0; }

glm::mat3 normal_matrix(const glm::mat4& world_from_object) {
  constexpr double FLAT = 1e-12;     // thinner by this than long and wide, a mesh counts as flat
  constexpr double SIDEWAYS = 1e-6;  // of what is left of a flat one: the square of its square fits 32 bits
  const glm::dmat3 placed(world_from_object);
  const double size = largest(placed);
  if (size == 0.0) return glm::mat3(1.0F);  // a point
  const glm::dmat3 m = over(placed, size);
  const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  const double determinant = glm::dot(m[0], cofactors[0]);
  const double most = largest(cofactors);
  glm::dmat3 normals(0.0);
  if (most > 0.0) normals = over(cofactors, is_mirroring(world_from_object) ? -most : most);
  // A normal that lies in what the mesh became goes where its direction goes; one that goes nowhere, nowhere else.
  if (std::abs(determinant) <= FLAT) normals += SIDEWAYS * m + SIDEWAYS * SIDEWAYS * glm::dmat3(1.0);
  return glm::mat3(normals);
}

}  // namespace lamp::app
