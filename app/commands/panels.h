// Stewart's figure 1.5 for any scene: the picture, the legend, and four heat maps on one scale; and the excess of each
// volume test.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "commands/request.h"
#include "error.h"

namespace lamp::app {

/// Writes the six panels to `out` and prints the table, as text or as JSON.
[[nodiscard]] Exit draw_panels(const Request& request, const std::filesystem::path& out, bool json);

}  // namespace lamp::app
