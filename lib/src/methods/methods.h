// The rows of the table, each made by its method's file.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lamplight/method.h"

namespace lamp {

[[nodiscard]] Method all_method();
/// `tiled`, its containers, and the presets of the sources.
[[nodiscard]] std::vector<Method> tiled_methods();
/// `clustered`, and the presets of its sources.
[[nodiscard]] std::vector<Method> clustered_methods();
[[nodiscard]] Method drobot_zbin_method();
[[nodiscard]] Method drobot_raster_tile_method();
[[nodiscard]] Method drobot_raster_cluster_method();
[[nodiscard]] Method lamplight_method();
[[nodiscard]] Method world_cells_method();
[[nodiscard]] Method world_tree_method();
[[nodiscard]] Method ikkala_grid_method();

}  // namespace lamp
