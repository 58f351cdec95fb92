// Lights as the text of a glTF file that holds nothing else, and back.
// Based on: Khronos, glTF 2.0 specification; KHR_lights_punctual.
// Promise: lights that were written and read are equal, but for rounding of a spot's direction.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lamplight/light.h"

namespace lamp::app {

/// What glTF cannot say of a light, `name` before it: a range of 0, a cone of 0. Empty where it can be written.
[[nodiscard]] std::string gltf_refusal(const Light& light, const std::string& name);

/// A node and a light of KHR_lights_punctual for each. Colours above 1 become intensity, and an inner angle that is the
/// outer one the next below, as the extension has it. Throws Error for the first that is refused.
[[nodiscard]] std::string gltf_text(std::span<const Light> lights, const std::string& name);

/// The point and spot lights that the nodes of a glTF text place, in the order of the nodes. Throws Error: `name`,
/// element, what was expected.
[[nodiscard]] std::vector<Light> lights_of_gltf(std::string_view text, const std::string& name);

}  // namespace lamp::app
