// Tiled culling: a tile's depth bounds, four side planes, a list of the spheres that touch it.
// Based on: Stewart, Compute-Based Tiled Culling, GPU Pro 7 (2016), section 1.3.
// Promise: lists ascend (the paper's append, then a sort); a list that does not fit is walked as all lights.
// SPDX-License-Identifier: Apache-2.0
#include "methods.h"
#include "parts.h"

namespace lamp {
namespace {

Plan plan_tiled(const Problem& problem) {
  const std::uint32_t tile_px = problem.options.integer("tile");
  const std::uint32_t capacity = problem.options.integer("capacity");
  const parts::TileGrid tiles = parts::tile_grid(problem, tile_px);
  const std::uint32_t threads = parts::cull_threads(problem, tile_px * tile_px);

  Plan plan;
  plan.cells = tiles.count();
  const ResourceId bounds = parts::add_light_bounds(plan, problem);
  const ResourceId counters = parts::add_counters(plan);
  const ResourceId lists =
      plan.add({.name = "tile lists", .bytes = tiles.count() * (1 + capacity) * sizeof(std::uint32_t)});

  const Pass light_bounds = parts::light_bounds_pass(bounds);
  plan.passes = {light_bounds,
                 {.name = "tiled cull",
                  .shader = "methods/tiled",
                  .constants = {threads, tile_px, capacity},
                  .bindings = {{INPUT_FRAME},
                               {INPUT_DEPTH},
                               {bounds},
                               {lists, Access::write},
                               {counters, Access::read_write}},
                  .extent = {.x = tiles.width, .y = tiles.height}}};
  plan.lookup = {
      .name = "tile_lists", .constants = {tile_px, capacity}, .bindings = {{INPUT_FRAME}, {lists}}};
  if (tile_px * tile_px <= problem.traits.max_group_invocations)
    plan.fused = FusedLookUp{.lookup = {.name = "tile_fused",
                                        .constants = {tile_px, capacity},
                                        .bindings = {{INPUT_FRAME}, {INPUT_DEPTH}, {bounds}}},
                             .passes = {light_bounds},
                             .group_width = tile_px,
                             .group_height = tile_px};
  return plan;
}

}  // namespace

Method tiled_method() {
  return {.name = "tiled",
          .title = "Tiled culling",
          .source = "Stewart, Compute-Based Tiled Culling, GPU Pro 7 (2016), 1.3",
          .summary = "Each tile tests every light's sphere against its four side planes and its depth bounds.",
          .result = "tile_lists",
          .options = {{.key = "tile", .help = "tile size, pixels", .fallback = "16", .choices = {"8", "16", "32"}},
                      {.key = "capacity",
                       .help = "lights a tile's list has room for",
                       .fallback = "512",
                       .min = 1,
                       .max = 2048}},
          .plan = plan_tiled};
}

}  // namespace lamp
