// The two containers of glTF: JSON text as it is, or a .glb that wraps JSON and one binary buffer.
// Based on: Khronos, glTF 2.0 specification, section 4 (GLB file format).
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace lamp::app {

/// Views into the bytes that were split.
struct GltfContainer {
  std::string_view json;
  std::optional<std::span<const std::byte>> binary;  ///< the BIN chunk of a .glb
};

/// Tells the container by the first bytes. Throws Error for a broken .glb header or chunk.
[[nodiscard]] GltfContainer split_container(std::span<const std::byte> bytes, const std::string& file);

}  // namespace lamp::app
