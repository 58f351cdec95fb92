// The lights that nodes of a glTF file carry.
// Based on: Khronos, KHR_lights_punctual.
// Promise: every light passes check_shown_lights.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "scene/gltf_document.h"
#include "scene/gltf_nodes.h"
#include "scene/scene.h"

namespace lamp::app {

struct GltfLights {
  std::vector<Light> lights;
  std::vector<DirectionalLight> directional_lights;
};

/// In the order of the nodes. Those that a scale of 0 hides are noted in the document. Throws Error.
[[nodiscard]] GltfLights read_lights(GltfDocument& document, std::span<const PlacedNode> nodes);

}  // namespace lamp::app
