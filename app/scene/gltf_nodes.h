// The node hierarchy of a glTF file, flattened: every node of the scene with its transform.
// Based on: Khronos, glTF 2.0 specification, section 3.5 (scenes, nodes, transformations).
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/gltf_document.h"

namespace lamp::app {

struct PlacedNode {
  int node = 0;
  glm::dmat4 world_from_node{1.0};
};

/// The nodes of the file's scene (its default, or the first, or all roots if it has none), parents before children.
/// Throws Error for a cycle, a node with two parents and a transform that is too large or not affine.
[[nodiscard]] std::vector<PlacedNode> place_nodes(const GltfDocument& document);

}  // namespace lamp::app
