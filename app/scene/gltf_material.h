// Materials of a glTF file, and which images they need in which colour space.
// Based on: Khronos, glTF 2.0 specification, section 3.9; KHR_materials_emissive_strength; KHR_texture_transform.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/gltf_document.h"
#include "scene/scene.h"

namespace lamp::app {

/// An image of the file as materials sample it. One that is used in both ways becomes two of the scene's images.
struct GltfImageUse {
  int image = -1;
  bool srgb = false;
};

struct GltfMaterials {
  std::vector<Material> materials;   ///< those of the file, then the default one for primitives without
  std::vector<GltfImageUse> images;  ///< what Texture::image points into
};

/// Throws Error. What of textures and samplers is left out is noted in the document.
[[nodiscard]] GltfMaterials read_materials(GltfDocument& document);

}  // namespace lamp::app
