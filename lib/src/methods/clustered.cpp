// Clustered culling: tiles cut into slices of depth, without reading the depth buffer; one list of any length a
// cluster. Based on: Olsson, Billeter, Assarsson, Clustered Deferred and Forward Shading, HPG (2012); Drobot, Improved
// Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017). Promise: right for any depth of a pixel; count,
// scan, fill, so lists are compact and ascend. SPDX-License-Identifier: Apache-2.0
#include "methods.h"
#include "parts.h"

namespace lamp {
namespace {

Plan plan_clustered(const Problem& problem) {
  const std::uint32_t tile_px = problem.options.integer("tile");
  const std::uint32_t slices = problem.options.integer("slices");
  const std::uint32_t near_mm = problem.options.integer("near_mm");
  const std::uint32_t far_m = problem.options.integer("far_m");
  const std::uint32_t scale = parts::slice_scale(problem.options.word("scale"));
  const parts::TileGrid tiles = parts::tile_grid(problem, tile_px);
  const std::uint32_t threads = parts::cull_threads(problem);
  const auto clusters = static_cast<std::uint32_t>(tiles.count() * slices);
  const std::uint64_t wanted = std::uint64_t{clusters} * problem.options.integer("mean_capacity");
  const auto entries = static_cast<std::uint32_t>(wanted);  // beyond 32 bits, plan_check refuses the buffer

  Plan plan;
  plan.cells = clusters;
  const ResourceId bounds = parts::add_light_bounds(plan, problem);
  const ResourceId counters = parts::add_counters(plan);
  const ResourceId ranges = plan.add({.name = "cluster ranges", .bytes = std::uint64_t{clusters} * 8});
  const ResourceId lists = plan.add({.name = "cluster lists", .bytes = wanted * 4});

  const std::vector<std::uint32_t> constants{threads, tile_px, slices, near_mm, far_m, entries, scale};
  const Extent one_group_a_tile{.x = tiles.width, .y = tiles.height};
  plan.passes = {parts::light_bounds_pass(bounds),
                 {.name = "cluster count",
                  .shader = "methods/clustered_count",
                  .constants = constants,
                  .bindings = {{INPUT_FRAME}, {bounds}, {ranges, Access::write}},
                  .extent = one_group_a_tile},
                 {.name = "cluster scan",
                  .shader = "methods/clustered_scan",
                  .constants = {threads, clusters, entries},
                  .bindings = {{ranges, Access::read_write}, {counters, Access::read_write}}},
                 {.name = "cluster fill",
                  .shader = "methods/clustered_fill",
                  .constants = constants,
                  .bindings = {{INPUT_FRAME}, {bounds}, {ranges}, {lists, Access::write}},
                  .extent = one_group_a_tile}};
  plan.lookup = {.name = "cluster_lists",
                 .constants = {tile_px, slices, near_mm, far_m, entries, scale},
                 .bindings = {{INPUT_FRAME}, {ranges}, {lists}}};
  return plan;
}

}  // namespace

Method clustered_method() {
  return {.name = "clustered",
          .title = "Clustered culling",
          .source = "Olsson et al., Clustered Deferred and Forward Shading, HPG (2012)",
          .summary = "Tiles cut into logarithmic slices of depth; every cluster gets a list, covered by pixels or not.",
          .result = "cluster_lists",
          .needs_depth = false,
          .any_depth = true,
          .options = {{.key = "tile", .help = "tile size, pixels", .fallback = "64", .choices = {"16", "32", "64"}},
                      {.key = "slices", .help = "slices of depth", .fallback = "24", .min = 1, .max = 32},
                      parts::slice_scale_option("scale", "log"),
                      parts::slice_near_option(),
                      parts::slice_far_option(),
                      {.key = "mean_capacity",
                       .help = "lights a cluster, on average, that the shared list has room for",
                       .fallback = "512",
                       .min = 1,
                       .max = 65536}},
          .plan = plan_clustered};
}

}  // namespace lamp
