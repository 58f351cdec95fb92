// Builds the two levels of a scene's hierarchy.
// SPDX-License-Identifier: Apache-2.0
#include "render/bvh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "scene/normal_matrix.h"
#include "scene/triangles.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t LEAF_TRIANGLES = 4;
// Of a mesh and of instances: together their stacks fit the least shared memory, at 64 threads.
constexpr std::uint32_t MESH_LEVELS = 30;
constexpr std::uint32_t UPPER_LEVELS = 24;
// Of the size of what a box holds: 32-bit rays are off by less, in the few operations that it takes.
constexpr float ROOM = 1e-6F;

float largest(const glm::vec3& v) { return std::max({v.x, v.y, v.z}); }

/// A little larger.
Box roomy(const Box& box, float room) { return {box.min - room, box.max + room}; }

float room_of(const Box& box) { return ROOM * largest(glm::max(glm::abs(box.min), glm::abs(box.max))) + 1e-30F; }

Box box_of(const gpu::BvhTriangle& t) {
  const std::array<glm::vec3, 3> corners{glm::vec3(t.a), glm::vec3(t.b), glm::vec3(t.c)};
  return {glm::min(corners[0], glm::min(corners[1], corners[2])),
          glm::max(corners[0], glm::max(corners[1], corners[2]))};
}

/// One mesh's, in the arrays of all.
struct MeshTree {
  std::uint32_t root = gpu::BVH_NOTHING;
  Box box;
};

class Builder {
 public:
  explicit Builder(const Scene& scene) : scene_(scene), meshes_(scene.meshes.size()) {}

  Bvh build() {
    for (std::uint32_t i = 0; i < scene_.instances.size(); ++i) add(i);
    add_upper_level();
    bvh_.stack += mesh_depth_;
    return std::move(bvh_);
  }

 private:
  void add(std::uint32_t number);
  MeshTree add_triangles(const Mesh& mesh, const Instance* placed);
  void add_upper_level();

  const Scene& scene_;
  Bvh bvh_;
  std::vector<std::optional<MeshTree>> meshes_;
  std::uint32_t mesh_depth_ = 0;
};

/// The matrix of directions from the world to the mesh; nothing where there is none that 32 bits hold.
std::optional<glm::mat3> inverse_of(const glm::mat4& world_from_object) {
  const glm::mat3 inverse(glm::inverse(glm::dmat3(world_from_object)));
  float sum = 0.0F;
  for (int i = 0; i < 3; ++i) sum += glm::dot(glm::abs(inverse[i]), glm::vec3(1.0F));
  const glm::dmat3 product = glm::dmat3(inverse) * glm::dmat3(world_from_object);
  double error = 0.0;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) error = std::max(error, std::abs(product[i][k] - (i == k ? 1.0 : 0.0)));
  if (!std::isfinite(sum) || !(error < 1e-3)) return std::nullopt;
  return inverse;
}

/// Where an instance is; what of the rest depends on it.
void place(gpu::BvhInstance& to, const glm::mat4& m, const glm::mat3& inverse) {
  const glm::mat3 rows = glm::transpose(inverse);
  to.row_x = Vec3(rows[0]);
  to.row_y = Vec3(rows[1]);
  to.row_z = Vec3(rows[2]);
  to.origin = Vec3(glm::vec3(m[3]));
  to.column_x = Vec3(glm::vec3(m[0]));
  to.column_y = Vec3(glm::vec3(m[1]));
  to.column_z = Vec3(glm::vec3(m[2]));
  const bool flips = is_mirroring(m);
  to.kind = (to.kind & ~gpu::BVH_FLIPPED) | (flips ? gpu::BVH_FLIPPED : 0U);
}

/// In the world, of an instance whose triangles are within `box`.
Box world_box(const gpu::BvhInstance& instance, const Box& box) {
  Box all{glm::vec3(std::numeric_limits<float>::max()), glm::vec3(std::numeric_limits<float>::lowest())};
  const glm::dmat3 columns(glm::dvec3(glm::vec3(instance.column_x)), glm::dvec3(glm::vec3(instance.column_y)),
                           glm::dvec3(glm::vec3(instance.column_z)));
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 corner((i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
                            (i & 4) != 0 ? box.max.z : box.min.z);
    const glm::vec3 at(columns * corner + glm::dvec3(glm::vec3(instance.origin)));
    all = joined(all, {at, at});
  }
  return roomy(all, room_of(all));
}

std::uint32_t shifted(std::uint32_t code, std::uint32_t by_nodes, std::uint32_t by_leaves) {
  if (code == gpu::BVH_NOTHING) return code;
  return code + gpu::BVH_COUNTS * (code % gpu::BVH_COUNTS == 0 ? by_nodes : by_leaves);
}

/// Behind others' nodes and leaves.
void append(std::vector<gpu::BvhNode>& to, std::vector<gpu::BvhNode> nodes, std::uint32_t first_leaf) {
  const auto first = static_cast<std::uint32_t>(to.size());
  for (gpu::BvhNode& node : nodes) {
    node.first = shifted(node.first, first, first_leaf);
    node.second = shifted(node.second, first, first_leaf);
    to.push_back(node);
  }
}

MeshTree Builder::add_triangles(const Mesh& mesh, const Instance* placed) {
  std::vector<gpu::BvhTriangle> triangles;
  for (std::uint32_t t = 0; t < triangle_count(mesh); ++t) {
    const std::array<const Vertex*, 3> corners = corners_of(scene_, mesh, t);
    std::array<glm::vec3, 3> at{corners[0]->position, corners[1]->position, corners[2]->position};
    if (placed != nullptr) at = world_triangle<float>(scene_, *placed, t);
    triangles.push_back({.a = Vec3(at[0]),
                         .first_index = mesh.first_index + 3 * t,
                         .b = Vec3(at[1]),
                         .unused_a = 0,
                         .c = Vec3(at[2]),
                         .unused_b = 0});
  }
  if (triangles.empty()) return {};
  MeshTree made{.box = box_of(triangles.front())};
  for (const gpu::BvhTriangle& t : triangles) made.box = joined(made.box, box_of(t));
  const float room = room_of(made.box);
  made.box = roomy(made.box, room);
  std::vector<Box> boxes;
  for (const gpu::BvhTriangle& t : triangles) boxes.push_back(roomy(box_of(t), room));
  BoxTree tree = make_box_tree(boxes, {.leaf = LEAF_TRIANGLES, .max_depth = MESH_LEVELS});
  const auto first_triangle = static_cast<std::uint32_t>(bvh_.triangles.size());
  made.root = shifted(tree.root, static_cast<std::uint32_t>(bvh_.nodes.size()), first_triangle);
  for (const std::uint32_t t : tree.order) bvh_.triangles.push_back(triangles[t]);
  append(bvh_.nodes, std::move(tree.nodes), first_triangle);
  mesh_depth_ = std::max(mesh_depth_, tree.depth);
  return made;
}

void Builder::add(std::uint32_t number) {
  const Instance& instance = scene_.instances[number];
  const Mesh& mesh = scene_.meshes[instance.mesh];
  const Material& material = scene_.materials[mesh.material];
  if (material.alpha_mode == AlphaMode::blend) return;
  const std::optional<glm::mat3> inverse = inverse_of(instance.world_from_object);
  std::optional<MeshTree> flattened;
  if (!inverse) flattened = add_triangles(mesh, &instance);
  if (inverse && !meshes_[instance.mesh]) meshes_[instance.mesh] = add_triangles(mesh, nullptr);
  const MeshTree& tree = inverse ? *meshes_[instance.mesh] : *flattened;
  if (tree.root == gpu::BVH_NOTHING) return;
  gpu::BvhInstance made{};
  made.root = tree.root;
  made.vertex_offset = mesh.vertex_offset;
  made.material = mesh.material;
  made.scene_instance = number;
  made.kind = (material.alpha_mode == AlphaMode::mask ? gpu::BVH_MASKED : 0U) |
              (material.double_sided ? gpu::BVH_DOUBLE_SIDED : 0U) | (inverse ? 0U : gpu::BVH_FLATTENED);
  place(made, inverse ? instance.world_from_object : glm::mat4(1.0F), inverse ? *inverse : glm::mat3(1.0F));
  bvh_.instances.push_back(made);
  bvh_.boxes.push_back(tree.box);
}

void Builder::add_upper_level() {
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < bvh_.instances.size(); ++i) boxes.push_back(world_box(bvh_.instances[i], bvh_.boxes[i]));
  BoxTree tree = make_box_tree(boxes, {.leaf = 1, .max_depth = UPPER_LEVELS});
  std::vector<gpu::BvhInstance> instances;
  std::vector<Box> own;
  for (const std::uint32_t i : tree.order) {
    instances.push_back(bvh_.instances[i]);
    own.push_back(bvh_.boxes[i]);
  }
  bvh_.instances = std::move(instances);
  bvh_.boxes = std::move(own);
  bvh_.first_upper = static_cast<std::uint32_t>(bvh_.nodes.size());
  bvh_.root = shifted(tree.root, bvh_.first_upper, 0);
  append(bvh_.nodes, std::move(tree.nodes), 0);
  bvh_.stack = tree.depth;
}

}  // namespace

Bvh make_bvh(const Scene& scene) { return Builder(scene).build(); }

bool refit(Bvh& bvh, const Scene& scene) {
  for (gpu::BvhInstance& instance : bvh.instances) {
    const glm::mat4& m = scene.instances[instance.scene_instance].world_from_object;
    const std::optional<glm::mat3> inverse = inverse_of(m);
    if (!inverse || (instance.kind & gpu::BVH_FLATTENED) != 0) {
      bvh = make_bvh(scene);
      return false;
    }
    place(instance, m, *inverse);
  }
  const auto box_of_child = [&](std::uint32_t code) {
    const std::uint32_t number = code / gpu::BVH_COUNTS;
    if (code % gpu::BVH_COUNTS != 0) return world_box(bvh.instances[number], bvh.boxes[number]);
    const gpu::BvhNode& node = bvh.nodes[number];
    return joined({glm::vec3(node.min_first), glm::vec3(node.max_first)},
                  {glm::vec3(node.min_second), glm::vec3(node.max_second)});
  };
  for (std::size_t i = bvh.nodes.size(); i-- > bvh.first_upper;) {
    gpu::BvhNode& node = bvh.nodes[i];
    const Box first = box_of_child(node.first);
    const Box second = box_of_child(node.second);
    node.min_first = Vec3(first.min);
    node.max_first = Vec3(first.max);
    node.min_second = Vec3(second.min);
    node.max_second = Vec3(second.max);
  }
  return true;
}

}  // namespace lamp::app
