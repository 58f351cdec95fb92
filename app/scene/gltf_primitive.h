// One primitive of a glTF mesh as a triangle list: attributes, indices, strips and fans, missing normals and tangents.
// Based on: Khronos, glTF 2.0 specification, section 3.7.2 (meshes); KHR_mesh_quantization.
// Promise: every index is below the vertex count, every number is finite.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scene/gltf_document.h"
#include "scene/gltf_skins.h"
#include "scene/tangents.h"

namespace lamp::app {

/// Where a primitive is, and what poses it.
struct GltfPrimitive {
  std::size_t mesh = 0;
  std::size_t primitive = 0;
  const GltfPose* pose = nullptr;  ///< of its skin; null: it has none
};

/// The triangles of a primitive, or nothing for points and lines and without positions. `normal_uv` is the texture
/// coordinate of its material's normal texture, if it has one: then missing tangents are made. Notes say what was
/// replaced. Throws Error.
[[nodiscard]] std::optional<Triangles> read_primitive(const GltfDocument& document, GltfPrimitive where,
                                                      std::optional<std::uint32_t> normal_uv,
                                                      std::vector<std::string>& notes);

}  // namespace lamp::app
