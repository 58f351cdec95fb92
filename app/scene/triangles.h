// The triangles of a scene's meshes, and where instances put them.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>

#include "scene/scene.h"

namespace lamp::app {

/// How many triangles a mesh has; indices behind the last whole one draw nothing.
[[nodiscard]] inline std::uint32_t triangle_count(const Mesh& mesh) { return mesh.index_count / 3; }

/// The corners of triangle `number` of a mesh.
[[nodiscard]] inline std::array<const Vertex*, 3> corners_of(const Scene& scene, const Mesh& mesh,
                                                             std::uint32_t number) {
  std::array<const Vertex*, 3> corners{};
  for (std::uint32_t i = 0; i < 3; ++i)
    corners[i] = &scene.vertices[scene.indices[mesh.first_index + 3 * number + i] + mesh.vertex_offset];
  return corners;
}

/// Around all of a mesh's; of no triangles, nothing: its ends are the wrong way round.
[[nodiscard]] inline Box mesh_box(const Scene& scene, const Mesh& mesh) {
  Box box{glm::vec3(std::numeric_limits<float>::max()), glm::vec3(std::numeric_limits<float>::lowest())};
  for (std::uint32_t t = 0; t < triangle_count(mesh); ++t)
    for (const Vertex* corner : corners_of(scene, mesh, t)) {
      box.min = glm::min(box.min, corner->position);
      box.max = glm::max(box.max, corner->position);
    }
  return box;
}

/// Positions of a triangle's corners in the world, m, in the arithmetic of T.
template <class T>
[[nodiscard]] std::array<glm::vec<3, T>, 3> world_triangle(const Scene& scene, const Instance& instance,
                                                           std::uint32_t number) {
  const glm::mat<4, 4, T> world_from_object(instance.world_from_object);
  const std::array<const Vertex*, 3> corners = corners_of(scene, scene.meshes[instance.mesh], number);
  std::array<glm::vec<3, T>, 3> at{};
  for (std::size_t i = 0; i < 3; ++i)
    at[i] = world_from_object * glm::vec<4, T>(glm::vec<3, T>(corners[i]->position), 1);
  return at;
}

}  // namespace lamp::app
