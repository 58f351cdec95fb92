// SPDX-License-Identifier: Apache-2.0
#include "gpu/lookup_cases.h"

#include <fmt/format.h>

namespace lamp::app {

void PrintTo(const LookUpCase& c, std::ostream* out) {
  *out << c.method << " " << fmt::format("{}", fmt::join(c.settings, " "));
}

std::vector<LookUpCase> lookup_cases() {
  return {{"all", "all", {}},
          {"tile_lists", "tiled", {"bounds=half"}},
          {"tile_lists", "tiled", {"capacity=8"}},
          {"tile_lists_scalar", "tiled", {"walk=scalar-cell"}},
          {"tile_typed", "tiled", {"order=type"}},
          {"tile_typed", "tiled", {"order=type", "mean_capacity=8"}},
          {"tile_bits", "tiled-bits", {}},
          {"tile_bits_scalar", "tiled-bits", {"walk=scalar-entity"}},
          {"tile_zbins", "drobot-zbin", {"walk=plain"}},
          {"tile_zbins_scalar", "drobot-zbin", {"walk=scalar-entity"}},
          {"cluster_lists", "clustered", {}},
          {"cluster_lists", "clustered", {"mean_capacity=1"}},
          {"cluster_lists_scalar", "clustered", {"walk=scalar-cell"}},
          {"cluster_bits", "clustered", {"container=bits"}},
          {"cluster_bits_scalar", "clustered", {"container=bits", "walk=scalar-entity"}},
          {"cell_lists", "lamplight", {"container=list", "tile=8"}},
          {"cell_lists", "lamplight", {"container=list", "depth=none"}},
          {"cell_lists", "lamplight", {"container=list", "mean_cells=1", "mean_capacity=1"}},
          {"cell_bits", "lamplight", {"container=bits", "tile=8"}},
          {"cell_bits", "lamplight", {"container=bits", "depth=none"}},
          {"world_cells", "world-cells", {}},
          {"world_cells", "world-cells", {"brick=800"}},
          {"world_cells", "world-cells", {"cells=16"}},
          {"world_cells", "world-cells", {"mean_bricks=1"}},
          {"implicit_grid", "ikkala-grid", {}},
          {"implicit_grid", "ikkala-grid", {"cells=8"}},
          {"implicit_grid", "ikkala-grid", {"order=index"}},
          {"world_tree", "world-tree", {}},
          {"cell_lists_stepped", "lamplight", {"container=list", "cells=list"}, LOOKUP_LIGHTS},
          {"cell_bits_stepped", "lamplight", {"container=bits", "cells=list"}, LOOKUP_LIGHTS}};
}

Problem problem_of(const LookUpCase& c, glm::uvec2 size) {
  DeviceTraits traits = test_context().device().traits;
  traits.max_loop_rounds = c.max_loop_rounds;
  return {.width = size.x,
          .height = size.y,
          .light_capacity = LOOKUP_LIGHTS,
          .options = take(resolve_options(*take(find_method(c.method)), c.settings)),
          .traits = traits};
}

}  // namespace lamp::app
