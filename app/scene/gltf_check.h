// Checks a glTF document before anything trusts it: types, ranges, lengths, and that every index points into its array.
// Based on: Khronos, glTF 2.0 specification and its JSON schemas, cut down to what the loader reads.
// Promise: after it, every value in the rules (gltf_rules.cpp) that is there has the type and range its rule says.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace lamp::app {

/// Throws Error for the first value that breaks a rule, named by its element ("mesh 0 primitive 2").
void check_gltf(const nlohmann::json& document, const std::string& file);

}  // namespace lamp::app
