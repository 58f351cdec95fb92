// Where the bytes of buffers and images come from: data URIs and files next to the scene.
// Based on: RFC 2397 (data URIs), RFC 3986 (percent encoding), RFC 4648 (base64).
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lamp::app {

/// The file that is loaded: its name for messages, and the folder that relative URIs start from (empty: none).
struct GltfOrigin {
  std::string file;
  std::filesystem::path folder;
};

[[nodiscard]] bool is_data_uri(std::string_view uri);

/// The file that a URI leads to; nothing where it is data. Throws Error unless it lies below the folder.
[[nodiscard]] std::optional<std::filesystem::path> external_file(const std::string& uri, const GltfOrigin& origin,
                                                                 const std::string& element);

/// The first `limit` bytes of what a URI names: base64 data, or a file by a relative path.
[[nodiscard]] std::vector<std::byte> read_uri(const std::string& uri, const GltfOrigin& origin,
                                              const std::string& element,
                                              std::size_t limit = std::numeric_limits<std::size_t>::max());

}  // namespace lamp::app
