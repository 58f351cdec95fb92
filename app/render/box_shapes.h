// Which settings a method gets in a frame with decals or probes.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "lamplight/method.h"

namespace lamp::app {

/// `settings`, and where the frame has boxes "boxes=shape", if the method has the option and nobody set it.
[[nodiscard]] std::vector<std::string> with_box_shapes(const Method& method, std::vector<std::string> settings,
                                                       bool boxes);
/// Whether boxes are culled by their shape.
[[nodiscard]] bool culls_shapes(const Options& options);

}  // namespace lamp::app
