// The node hierarchy of a glTF file, flattened: every node of the scene with its transform.
// Based on: Khronos, glTF 2.0 specification, section 3.5 (scenes, nodes, transformations).
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_nodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "scene/gltf_error.h"
#include "scene/scene.h"

namespace lamp::app {
namespace {

/// Translation, rotation and scale, or the matrix that stands for them.
glm::dmat4 local_transform(const GltfDocument& document, int index) {
  const tinygltf::Node& node = document.model.nodes[static_cast<std::size_t>(index)];
  const std::string& file = document.origin.file;
  if (!node.matrix.empty()) {
    const glm::dmat4 matrix = glm::make_mat4(node.matrix.data());
    if (matrix[0][3] != 0.0 || matrix[1][3] != 0.0 || matrix[2][3] != 0.0 || matrix[3][3] != 1.0) {
      gltf_fail(file, fmt::format("node {}", index),
                "matrix has a last row that is not 0 0 0 1, expected an affine one");
    }
    return matrix;
  }
  glm::dmat4 matrix(1.0);
  if (!node.rotation.empty()) {
    const glm::dquat rotation(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
    if (!(glm::length(rotation) > 1e-6)) {
      gltf_fail(file, fmt::format("node {}", index), "rotation has length 0, expected a unit quaternion");
    }
    matrix = glm::mat4_cast(glm::normalize(rotation));
  }
  if (!node.scale.empty()) {
    for (int axis = 0; axis < 3; ++axis) matrix[axis] *= node.scale[static_cast<std::size_t>(axis)];
  }
  if (!node.translation.empty()) {
    matrix[3] = glm::dvec4(node.translation[0], node.translation[1], node.translation[2], 1.0);
  }
  return matrix;
}

/// Whether products with positions stay well within floats.
bool is_moderate(const glm::dmat4& matrix) {
  const double* numbers = glm::value_ptr(matrix);
  return std::all_of(numbers, numbers + 16, [](double number) { return std::abs(number) <= FURTHEST_M; });
}

/// The nodes that the scene begins with.
std::vector<int> roots(const tinygltf::Model& model) {
  if (!model.scenes.empty()) return model.scenes[static_cast<std::size_t>(std::max(model.defaultScene, 0))].nodes;
  std::vector<bool> is_child(model.nodes.size(), false);
  for (const tinygltf::Node& node : model.nodes) {
    for (const int child : node.children) is_child[static_cast<std::size_t>(child)] = true;
  }
  std::vector<int> result;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    if (!is_child[i]) result.push_back(static_cast<int>(i));
  }
  return result;
}

}  // namespace

std::optional<glm::dvec3> axis_of(const PlacedNode& placed, int axis) {
  const glm::dvec3 column(placed.world_from_node[axis]);
  const double length = glm::length(column);
  return length > 1e-12 ? std::optional(column / length) : std::nullopt;
}

bool is_hidden(const PlacedNode& placed) { return !axis_of(placed, 0) && !axis_of(placed, 1) && !axis_of(placed, 2); }

void note_hidden(std::size_t count, std::string_view what, std::vector<std::string>& notes) {
  if (count > 0) notes.push_back(fmt::format("{} {} left out: a scale of 0 hides them", count, what));
}

std::vector<PlacedNode> place_nodes(const GltfDocument& document) {
  const tinygltf::Model& model = document.model;
  // A stack of our own: a file may nest deeper than calls can.
  std::vector<PlacedNode> stack;
  const auto push = [&stack](const std::vector<int>& nodes, const glm::dmat4& parent) {
    for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) stack.push_back({*node, parent});
  };
  push(roots(model), glm::dmat4(1.0));

  std::vector<PlacedNode> placed;
  std::vector<bool> seen(model.nodes.size(), false);
  while (!stack.empty()) {
    PlacedNode next = stack.back();
    stack.pop_back();
    const std::string element = fmt::format("node {}", next.node);
    if (seen[static_cast<std::size_t>(next.node)]) {
      gltf_fail(document.origin.file, element, "is reached twice from the scene, expected a tree without cycles");
    }
    seen[static_cast<std::size_t>(next.node)] = true;
    next.world_from_node = next.world_from_node * local_transform(document, next.node);
    if (!is_moderate(next.world_from_node)) {
      gltf_fail(document.origin.file, element, "its transform in the world is too large, expected numbers up to 1e15");
    }
    placed.push_back(next);
    push(model.nodes[static_cast<std::size_t>(next.node)].children, next.world_from_node);
  }
  return placed;
}

}  // namespace lamp::app
