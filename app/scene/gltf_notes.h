// What of a glTF document has no effect, and what glTF forbids but files often have: counted, in the scene's notes.
// Based on: Khronos, glTF 2.0 specification; KHR_lights_punctual.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace lamp::app {

/// The document must have passed check_gltf().
void note_left_out(const nlohmann::json& document, std::vector<std::string>& notes);

/// What is forbidden and read all the same, as it is clear what is meant. Likewise.
void note_allowed(const nlohmann::json& document, std::vector<std::string>& notes);

}  // namespace lamp::app
