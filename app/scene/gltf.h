// glTF 2.0 (.gltf, .glb) to a Scene, through tinygltf.
// Based on: Khronos, glTF 2.0 specification; KHR_lights_punctual; KHR_texture_transform.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "scene/scene.h"

namespace lamp::app {

/// Loads a file. Throws Error with one line (file, element, what is wrong, what was expected).
[[nodiscard]] Scene load_gltf(const std::filesystem::path& file);

/// The same from memory (.gltf JSON or .glb, told by the first bytes); external files are looked for in `folder`.
[[nodiscard]] Scene load_gltf(std::span<const std::byte> bytes, const std::filesystem::path& folder,
                              const std::string& name);

}  // namespace lamp::app
