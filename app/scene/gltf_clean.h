// A glTF document before tinygltf reads it: without what nothing reads, and with numbers that tinygltf keeps as they
// are. Based on: Khronos, glTF 2.0 specification, section 2.7 (JSON encoding).
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>

namespace lamp::app {

/// The extensions that the loader reads.
inline constexpr auto GLTF_EXTENSIONS = std::to_array<std::string_view>(
    {"KHR_lights_punctual", "KHR_materials_emissive_strength", "KHR_mesh_quantization", "KHR_texture_transform"});

[[nodiscard]] bool is_supported(std::string_view extension);

/// Makes integers of whole numbers that are written with a point or an exponent ("48.0", "4.8e1"), as the
/// specification lets any number be.
void make_whole(nlohmann::json& value);

/// Drops extensions that are not supported, and of extras all but a probe. The result names the extensions that were
/// dropped.
[[nodiscard]] std::set<std::string> drop_unread(nlohmann::json& document);

}  // namespace lamp::app
