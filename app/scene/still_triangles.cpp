// Collects triangles.
// SPDX-License-Identifier: Apache-2.0
#include "scene/still_triangles.h"

namespace lamp::app {

std::vector<OccluderTriangle> still_triangles(const Scene& scene) {
  std::vector<OccluderTriangle> triangles;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    if (scene.materials[mesh.material].alpha_mode != AlphaMode::opaque) continue;
    const glm::dmat4 world_from_object(instance.world_from_object);
    for (std::uint32_t at = 0; at + 2 < mesh.index_count; at += 3) {
      OccluderTriangle triangle{};
      for (std::uint32_t i = 0; i < 3; ++i) {
        const glm::vec3& p = scene.vertices[scene.indices[mesh.first_index + at + i] + mesh.vertex_offset].position;
        triangle[i] = DVec3(glm::dvec3(world_from_object * glm::dvec4(glm::dvec3(p), 1.0)));
      }
      triangles.push_back(triangle);
    }
  }
  return triangles;
}

}  // namespace lamp::app
