// A glTF file, read and checked: the model as tinygltf gives it, and the bytes of its buffers.
// Based on: Khronos, glTF 2.0 specification.
// Promise: indices between elements, buffer views and numbers that the loader reads are in range; see gltf_rules.h.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "scene/gltf_resources.h"

namespace lamp::app {

/// Of the one member of extras that is kept: a node's probe (gltf_probes.h).
inline constexpr const char* PROBE_KEY = "lamplight_probe";

/// An image that nobody has decoded yet: a part of a buffer, or where there is none (-1) from a URI.
struct GltfImage {
  std::string name;
  std::string uri;
  int buffer_view = -1;
  int first_alike = 0;  ///< the first image of the same source
};

struct GltfDocument {
  GltfOrigin origin;
  tinygltf::Model model;  ///< without buffers and images, which are here
  std::vector<std::vector<std::byte>> buffers;
  std::vector<GltfImage> images;
  std::vector<std::string> notes;            ///< what was left out, for Scene::notes
  std::vector<std::filesystem::path> files;  ///< that the buffers were read from, besides its own

  /// The bytes of a buffer view.
  [[nodiscard]] std::span<const std::byte> view_bytes(int buffer_view) const;
};

/// Reads the container, the JSON and the buffers. Throws Error.
[[nodiscard]] GltfDocument read_document(std::span<const std::byte> bytes, GltfOrigin origin);

}  // namespace lamp::app
