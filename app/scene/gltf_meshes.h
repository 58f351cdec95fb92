// The meshes of a glTF file that its scene places, as meshes and instances of a Scene.
// Based on: Khronos, glTF 2.0 specification, sections 3.7.2 (meshes), 3.7.3 (skins), 3.5.3 (mirroring).
// Promise: front faces stay counter-clockwise: a mesh that is placed mirrored gets a mirrored copy.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "scene/gltf_document.h"
#include "scene/gltf_nodes.h"
#include "scene/scene.h"

namespace lamp::app {

/// Fills the scene's vertices, indices, meshes and instances. `scene.materials` are the file's and the default one.
/// Throws Error. What is left out is noted in the document.
void add_meshes(GltfDocument& document, std::span<const PlacedNode> nodes, Scene& scene);

}  // namespace lamp::app
