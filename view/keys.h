// What keys do, and the words for it.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string_view>

#include "view/input.h"
#include "view/panels.h"

namespace lamp::app {

struct KeyHelp {
  std::string_view keys;
  std::string_view does;  ///< a sentence
};
/// All of them, for the help and for docs.
[[nodiscard]] std::span<const KeyHelp> key_help();

/// Applies the keys that were pressed in this frame. Those that ImGui moves its focus with are left alone where
/// `focus` says that it does.
void apply_keys(const Input& input, ViewState& state, const Shown& shown, Wishes& wishes, bool focus);

/// Flies with the keys that are held and by a look of the mouse, in radians; `seconds` since the last frame. Leaves the
/// scene's camera for a free one.
void fly(const Input& input, ViewState& state, const Shown& shown, glm::dvec2 look, float seconds, bool focus);

}  // namespace lamp::app
