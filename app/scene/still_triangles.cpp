// Collects triangles.
// SPDX-License-Identifier: Apache-2.0
#include "scene/still_triangles.h"

#include "scene/triangles.h"

namespace lamp::app {

std::vector<OccluderTriangle> still_triangles(const Scene& scene) {
  std::vector<OccluderTriangle> triangles;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    if (scene.materials[mesh.material].alpha_mode != AlphaMode::opaque) continue;
    for (std::uint32_t t = 0; t < triangle_count(mesh); ++t) {
      const auto [a, b, c] = world_triangle<double>(scene, instance, t);
      triangles.push_back({DVec3(a), DVec3(b), DVec3(c)});
    }
  }
  return triangles;
}

}  // namespace lamp::app
