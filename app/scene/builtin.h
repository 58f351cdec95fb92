// The built-in scenes: procedural, deterministic, each with a camera and a flight.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

#include "scene/scene.h"

namespace lamp::app {

struct BuiltinScene {
  std::string_view name;
  std::string_view summary;  ///< one line for `lamp list scenes`
  Scene (*make)();
  bool adversarial = false;  ///< made to be hard on culling: docs/scenes.md
};

/// Every built-in scene; the first is the default of the command line.
[[nodiscard]] std::span<const BuiltinScene> builtin_scenes();

}  // namespace lamp::app
