// The node hierarchy of a glTF file, flattened: every node of the scene with its transform.
// Based on: Khronos, glTF 2.0 specification, section 3.5 (scenes, nodes, transformations).
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/gltf_document.h"

namespace lamp::app {

struct PlacedNode {
  int node = 0;
  glm::dmat4 world_from_node{1.0};
};

/// The direction of an axis of a node in the world; nothing where a scale of 0 leaves it none.
[[nodiscard]] std::optional<glm::dvec3> axis_of(const PlacedNode& placed, int axis);

/// Whether a scale of 0 along every axis hides what the node holds.
[[nodiscard]] bool is_hidden(const PlacedNode& placed);

/// "2 lights left out: ..." for things whose nodes have such a scale.
void note_hidden(std::size_t count, std::string_view what, std::vector<std::string>& notes);

/// The nodes of the file's scene (its default, or the first, or all roots if it has none), parents before children.
/// Throws Error for a cycle, a node with two parents and a transform that is too large or not affine.
[[nodiscard]] std::vector<PlacedNode> place_nodes(const GltfDocument& document);

}  // namespace lamp::app
