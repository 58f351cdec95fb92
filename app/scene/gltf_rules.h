// What a value of a glTF document must be, as data: one rule for each value that the loader reads.
// Based on: Khronos, glTF 2.0 specification and its JSON schemas; KHR_lights_punctual; KHR_texture_transform;
// KHR_materials_emissive_strength.
// Promise: after check_gltf(), every value that the loader reads has the type and range its rule says, and every index
// points into its array.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace lamp::app {

/// Throws Error for the first value that breaks a rule, named by its element ("mesh 0 primitive 2").
void check_gltf(const nlohmann::json& document, const std::string& file);

/// An array of the document, empty where there is none.
[[nodiscard]] const nlohmann::json& gltf_array(const nlohmann::json& document, const char* array);

}  // namespace lamp::app
