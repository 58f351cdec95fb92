// The cameras that nodes of a glTF file carry.
// Based on: Khronos, glTF 2.0 specification, section 3.10 (cameras).
// Promise: rigid poses, whatever scale the nodes have; every camera gives a view.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "scene/gltf_document.h"
#include "scene/gltf_nodes.h"
#include "scene/scene.h"

namespace lamp::app {

/// In the order of the nodes, named like them or, where they have no name, like themselves. Those that a scale
/// of 0 hides are noted in the document. Throws Error.
[[nodiscard]] std::vector<Camera> read_cameras(GltfDocument& document, std::span<const PlacedNode> nodes);

}  // namespace lamp::app
