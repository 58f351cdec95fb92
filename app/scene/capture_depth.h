// Depth as an engine wrote it to depth as Lamplight wants it: reversed device depth, 0 for sky.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "scene/capture_json.h"

namespace lamp::app {

/// Converts in place (`reversed` stays bit for bit) and checks every pixel. `file` names the values in errors. Throws
/// Error that names the first pixel that is no depth of this view.
void convert_depth(std::vector<float>& depth, DepthKind kind, const View& view, const std::string& file);

}  // namespace lamp::app
