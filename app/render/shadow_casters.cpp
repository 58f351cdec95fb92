// Cuts meshes into runs of triangles.
// SPDX-License-Identifier: Apache-2.0
#include "render/shadow_casters.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lamp::app {
namespace {

// Triangles. Small enough that a square at a light draws little that it does not show, large enough that a scene of
// millions has some ten thousand of them.
constexpr std::uint32_t CLUSTER_TRIANGLES = 256;

struct Cluster {
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;
  glm::vec3 center{0.0F};
  float radius = 0.0F;
};

Cluster cluster_of(const Scene& scene, const Mesh& mesh, std::uint32_t first, std::uint32_t count) {
  const auto position = [&](std::uint32_t i) {
    return scene.vertices[scene.indices[first + i] + mesh.vertex_offset].position;
  };
  glm::vec3 low(std::numeric_limits<float>::max());
  glm::vec3 high(std::numeric_limits<float>::lowest());
  for (std::uint32_t i = 0; i < count; ++i) {
    low = glm::min(low, position(i));
    high = glm::max(high, position(i));
  }
  Cluster cluster{.first_index = first, .index_count = count, .center = (low + high) * 0.5F};
  for (std::uint32_t i = 0; i < count; ++i)
    cluster.radius = std::max(cluster.radius, glm::length(position(i) - cluster.center));
  return cluster;
}

std::vector<Cluster> clusters_of(const Scene& scene, const Mesh& mesh) {
  std::vector<Cluster> clusters;
  for (std::uint32_t at = 0; at < mesh.index_count; at += 3 * CLUSTER_TRIANGLES)
    clusters.push_back(
        cluster_of(scene, mesh, mesh.first_index + at, std::min(mesh.index_count - at, 3 * CLUSTER_TRIANGLES)));
  return clusters;
}

void add_casters(const GpuScene& scene, const Draw& draw, ShadowCasters& to) {
  const Mesh& mesh = scene.scene().meshes[draw.mesh];
  const std::vector<Cluster> clusters = clusters_of(scene.scene(), mesh);
  for (std::uint32_t i = 0; i < draw.instances; ++i)
    for (const Cluster& cluster : clusters) {
      to.casters.push_back({.center = cluster.center,
                            .radius = cluster.radius,
                            .instance = draw.first_instance + i,
                            .group = static_cast<std::uint32_t>(to.groups.size())});
      to.draws.push_back(
          {.indices = cluster.index_count, .first_index = cluster.first_index, .vertex_offset = mesh.vertex_offset});
    }
}

}  // namespace

ShadowCasters shadow_casters(const GpuScene& scene) {
  ShadowCasters all;
  const auto add_group = [&](bool masked, auto is_in) {
    const auto first = static_cast<std::uint32_t>(all.casters.size());
    std::uint32_t material = 0;
    for (const Draw& draw : scene.opaque()) {
      if (!is_in(draw)) continue;
      material = scene.scene().meshes[draw.mesh].material;
      add_casters(scene, draw, all);
    }
    const std::uint32_t count = static_cast<std::uint32_t>(all.casters.size()) - first;
    if (count != 0) all.groups.push_back({.masked = masked, .material = material, .first = first, .count = count});
  };
  const auto is_masked = [&](const Draw& draw) { return scene.material_of(draw).alpha_mode == AlphaMode::mask; };
  add_group(false, [&](const Draw& draw) { return !is_masked(draw); });
  for (std::uint32_t i = 0; i < scene.scene().materials.size(); ++i)
    add_group(true, [&](const Draw& draw) { return is_masked(draw) && scene.scene().meshes[draw.mesh].material == i; });
  return all;
}

}  // namespace lamp::app
