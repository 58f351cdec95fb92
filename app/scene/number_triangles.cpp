// Gives each triangle a vertex of its own, and copies of vertices where there are too few.
// SPDX-License-Identifier: Apache-2.0
#include "scene/number_triangles.h"

#include <array>
#include <unordered_map>

#include "scene/triangles.h"

namespace lamp::app {
namespace {

class Numbering {
 public:
  Numbering(const Scene& scene, const Mesh& mesh) : scene_(scene), mesh_(mesh) {}

  /// Appends the mesh, as it is to be drawn.
  Mesh run(std::vector<Vertex>& vertices, std::vector<std::uint32_t>& indices) {
    const std::uint32_t count = triangle_count(mesh_);
    const Mesh numbered{.first_index = static_cast<std::uint32_t>(indices.size()),
                        .index_count = 3 * count,
                        .vertex_offset = static_cast<std::uint32_t>(vertices.size()),
                        .material = mesh_.material};
    std::vector<std::uint32_t> first(count);  // which corner is the first
    for (std::uint32_t t = 0; t < count; ++t) {
      while (first[t] < 3 && places_.contains(index(t, first[t]))) ++first[t];
      first[t] %= 3;  // all are there: a copy of one
      places_.try_emplace(index(t, first[t]), t);
      vertices.push_back(vertex(index(t, first[t])));
    }
    for (std::uint32_t t = 0; t < count; ++t) {
      indices.push_back(t);
      for (std::uint32_t i = 1; i < 3; ++i) {
        const std::uint32_t old = index(t, (first[t] + i) % 3);
        const auto next = static_cast<std::uint32_t>(vertices.size()) - numbered.vertex_offset;
        const auto [place, is_new] = places_.try_emplace(old, next);
        if (is_new) vertices.push_back(vertex(old));
        indices.push_back(place->second);
      }
    }
    return numbered;
  }

 private:
  [[nodiscard]] std::uint32_t index(std::uint32_t triangle, std::uint32_t corner) const {
    return scene_.indices[mesh_.first_index + 3 * triangle + corner];
  }
  [[nodiscard]] Vertex vertex(std::uint32_t index) const { return scene_.vertices[index + mesh_.vertex_offset]; }

  const Scene& scene_;
  const Mesh& mesh_;
  std::unordered_map<std::uint32_t, std::uint32_t> places_;  ///< of old indices among the mesh's new vertices
};

}  // namespace

void number_triangles(Scene& scene) {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<Mesh> meshes;
  for (const Mesh& mesh : scene.meshes) meshes.push_back(Numbering(scene, mesh).run(vertices, indices));
  scene.vertices = std::move(vertices);
  scene.indices = std::move(indices);
  scene.meshes = std::move(meshes);
}

}  // namespace lamp::app
