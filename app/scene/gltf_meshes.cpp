// The meshes of a glTF file that its scene places, as meshes and instances of a Scene.
// Based on: Khronos, glTF 2.0 specification, sections 3.7.2 (meshes), 3.7.3 (skins), 3.5.3 (mirroring).
// Promise: front faces stay counter-clockwise: a mesh that is placed mirrored gets a mirrored copy.
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <compare>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "scene/gltf_error.h"
#include "scene/gltf_primitive.h"
#include "scene/gltf_skins.h"
#include "scene/normal_matrix.h"

namespace lamp::app {
namespace {

// One small accessor may be used by any number of primitives: bounds on what that adds up to.
constexpr std::size_t VERTICES_MAX = std::size_t{1} << 26;
constexpr std::size_t INDICES_MAX = std::size_t{1} << 28;
constexpr std::size_t INSTANCES_MAX = std::size_t{1} << 22;

/// Whether one of the material's textures is looked up by coordinates that the primitive does not have.
bool lacks_coordinates(const tinygltf::Primitive& primitive, const Material& material) {
  for (const Texture* texture : {&material.base_color_texture, &material.metallic_roughness_texture,
                                 &material.normal_texture, &material.occlusion_texture, &material.emissive_texture})
    if (texture->image >= 0 && !primitive.attributes.contains(fmt::format("TEXCOORD_{}", texture->uv))) return true;
  return false;
}

/// A mesh of the file as nodes use it: each of these is a copy.
struct MeshUse {
  std::size_t mesh = 0;
  int skin = -1;  ///< that poses it, in the world; -1: none
  bool mirrored = false;

  auto operator<=>(const MeshUse&) const = default;
};

class MeshBuilder {
 public:
  MeshBuilder(GltfDocument& document, std::span<const PlacedNode> nodes, Scene& scene)
      : document_(document), scene_(scene), poses_(document, nodes) {}

  /// The scene's meshes, one a primitive, of a mesh of the file; made when first asked for.
  const std::vector<std::uint32_t>& meshes(const MeshUse& use) {
    const auto [found, added] = made_.try_emplace(use);
    if (added) found->second = use.mirrored ? mirror(meshes({use.mesh, use.skin})) : convert(use.mesh, use.skin);
    return found->second;
  }

  [[nodiscard]] std::size_t left_out() const { return left_out_.size(); }
  [[nodiscard]] std::size_t without_positions() const { return without_positions_.size(); }
  [[nodiscard]] std::size_t without_coordinates() const { return without_coordinates_.size(); }

 private:
  std::vector<std::uint32_t> convert(std::size_t mesh, int skin) {
    const GltfPose* const pose = skin < 0 ? nullptr : &poses_.of(skin);
    std::vector<std::uint32_t> result;
    const auto& primitives = document_.model.meshes[mesh].primitives;
    for (std::size_t i = 0; i < primitives.size(); ++i) {
      const auto material =
          primitives[i].material < 0 ? scene_.materials.size() - 1 : static_cast<std::size_t>(primitives[i].material);
      const Texture& normal_texture = scene_.materials[material].normal_texture;
      const auto normal_uv = normal_texture.image < 0 ? std::nullopt : std::optional(normal_texture.uv);
      std::vector<std::string> notes;
      const std::optional<Triangles> triangles = read_primitive(document_, {mesh, i, pose}, normal_uv, notes);
      note_once(notes);
      if (!triangles) {
        (primitives[i].mode < TINYGLTF_MODE_TRIANGLES ? left_out_ : without_positions_).emplace(mesh, i);
        continue;
      }
      if (lacks_coordinates(primitives[i], scene_.materials[material])) without_coordinates_.emplace(mesh, i);
      result.push_back(append(*triangles, static_cast<std::uint32_t>(material), mesh));
    }
    return result;
  }

  /// Copies of a mesh would say the same again.
  void note_once(const std::vector<std::string>& notes) {
    for (const std::string& note : notes)
      if (noted_.insert(note).second) document_.notes.push_back(note);
  }

  std::uint32_t append(const Triangles& triangles, std::uint32_t material, std::size_t mesh) {
    if (triangles.vertices.size() > VERTICES_MAX - scene_.vertices.size() ||
        triangles.indices.size() > INDICES_MAX - scene_.indices.size()) {
      gltf_fail(
          document_.origin.file, fmt::format("mesh {}", mesh),
          fmt::format("the scene grows beyond {} vertices or {} indices, expected fewer", VERTICES_MAX, INDICES_MAX));
    }
    scene_.meshes.push_back({static_cast<std::uint32_t>(scene_.indices.size()),
                             static_cast<std::uint32_t>(triangles.indices.size()),
                             static_cast<std::uint32_t>(scene_.vertices.size()), material});
    scene_.vertices.insert(scene_.vertices.end(), triangles.vertices.begin(), triangles.vertices.end());
    scene_.indices.insert(scene_.indices.end(), triangles.indices.begin(), triangles.indices.end());
    return static_cast<std::uint32_t>(scene_.meshes.size() - 1);
  }

  /// Copies with each triangle turned round and each tangent frame of the other hand, as mirroring undoes both.
  std::vector<std::uint32_t> mirror(const std::vector<std::uint32_t>& originals) {
    std::vector<std::uint32_t> result;
    for (const std::uint32_t original : originals) {
      const Mesh mesh = scene_.meshes[original];
      Triangles triangles;
      std::uint32_t vertex_count = 0;
      for (std::uint32_t i = 0; i < mesh.index_count; ++i) {
        triangles.indices.push_back(scene_.indices[mesh.first_index + i]);
        vertex_count = std::max(vertex_count, triangles.indices.back() + 1);
      }
      for (std::size_t i = 0; i + 3 <= triangles.indices.size(); i += 3) {
        std::swap(triangles.indices[i + 1], triangles.indices[i + 2]);
      }
      for (std::uint32_t i = 0; i < vertex_count; ++i) {
        triangles.vertices.push_back(scene_.vertices[mesh.vertex_offset + i]);
        triangles.vertices.back().tangent.w *= -1.0F;
      }
      result.push_back(append(triangles, mesh.material, original));
    }
    return result;
  }

  GltfDocument& document_;
  Scene& scene_;
  GltfPoses poses_;
  std::map<MeshUse, std::vector<std::uint32_t>> made_;
  std::set<std::string> noted_;
  std::set<std::pair<std::size_t, std::size_t>> left_out_;             ///< mesh and primitive
  std::set<std::pair<std::size_t, std::size_t>> without_positions_;    ///< likewise
  std::set<std::pair<std::size_t, std::size_t>> without_coordinates_;  ///< likewise
};

}  // namespace

void add_meshes(GltfDocument& document, std::span<const PlacedNode> nodes, Scene& scene) {
  MeshBuilder builder(document, nodes, scene);
  for (const PlacedNode& placed : nodes) {
    const tinygltf::Node& node = document.model.nodes[static_cast<std::size_t>(placed.node)];
    if (node.mesh < 0) continue;
    // A skinned mesh is where its joints are, wherever its own node is.
    const glm::mat4 world_from_object(node.skin < 0 ? placed.world_from_node : glm::dmat4(1.0));
    const MeshUse use{static_cast<std::size_t>(node.mesh), node.skin, is_mirroring(world_from_object)};
    for (const std::uint32_t made : builder.meshes(use)) scene.instances.push_back({made, world_from_object});
    if (scene.instances.size() > INSTANCES_MAX) {
      gltf_fail(document.origin.file, fmt::format("node {}", placed.node),
                fmt::format("the scene grows beyond {} instances, expected fewer", INSTANCES_MAX));
    }
  }
  if (builder.left_out() > 0) {
    document.notes.push_back(fmt::format("{} primitives of points or lines left out", builder.left_out()));
  }
  if (builder.without_positions() > 0) {
    document.notes.push_back(fmt::format("{} primitives without POSITION left out", builder.without_positions()));
  }
  if (builder.without_coordinates() > 0) {
    document.notes.push_back(fmt::format("{} primitives lack texture coordinates: a texture of theirs is one colour",
                                         builder.without_coordinates()));
  }
  if (scene.instances.empty()) {
    gltf_fail(document.origin.file, "scene", "has no triangles, expected a node with a mesh that has some");
  }
}

}  // namespace lamp::app
