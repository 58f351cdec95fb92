// Clustered culling: tiles cut into slices of depth, without reading the depth buffer; one list of any length a
// cluster. Based on: Olsson, Billeter, Assarsson, Clustered Deferred and Forward Shading, HPG (2012); Drobot, Improved
// Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017). Promise: right for any depth of a pixel; count,
// scan, fill, so lists are compact and ascend. SPDX-License-Identifier: Apache-2.0
#include "methods.h"
#include "parts.h"

namespace lamp {
namespace {

/// A tile's bits serve where lists do not fit; beyond this size of them all, every light serves.
constexpr std::uint64_t MOST_BIT_BYTES = 1U << 26;  // a million lights at 1920x1080

/// Words of a tile's bits, 0 if there shall be none.
std::uint32_t words_of_a_tile(const Problem& problem, const parts::TileGrid& tiles) {
  const std::uint32_t words = parts::divide_up(parts::capacity(problem), 32);
  const std::uint64_t bytes = tiles.count() * words * 4;
  return bytes <= std::min(MOST_BIT_BYTES, problem.traits.max_storage_buffer_bytes) ? words : 0;
}

Plan plan_clustered(const Problem& problem) {
  const std::uint32_t tile_px = problem.options.integer("tile");
  const std::uint32_t slices = problem.options.integer("slices");
  const std::uint32_t near_mm = problem.options.integer("near_mm");
  const std::uint32_t far_m = problem.options.integer("far_m");
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
  const std::uint32_t words = words_of_a_tile(problem, tiles);
  // Bound to the list, and not used, where there are none.
  const ResourceId bits = words == 0 ? lists : plan.add({.name = "tile bits", .bytes = tiles.count() * words * 4});

  const Extent one_group_a_tile{.x = tiles.width, .y = tiles.height};
  plan.passes = {parts::light_bounds_pass(bounds),
                 {.name = "cluster count",
                  .shader = "methods/clustered_count",
                  .constants = {threads, tile_px, slices, near_mm, far_m},
                  .bindings = {{INPUT_FRAME}, {bounds}, {ranges, Access::write}},
                  .extent = one_group_a_tile},
                 {.name = "cluster scan",
                  .shader = "methods/clustered_scan",
                  .constants = {threads, clusters, entries},
                  .bindings = {{ranges, Access::read_write}, {counters, Access::read_write}}},
                 {.name = "cluster fill",
                  .shader = "methods/clustered_fill",
                  .constants = {threads, tile_px, slices, near_mm, far_m, entries, words},
                  .bindings = {{INPUT_FRAME}, {bounds}, {ranges}, {lists, Access::write}, {bits, Access::write}},
                  .extent = one_group_a_tile}};
  plan.lookup = {.name = "cluster_lists",
                 .constants = {tile_px, slices, near_mm, far_m, entries, words},
                 .bindings = {{INPUT_FRAME}, {ranges}, {lists}, {bits}}};
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
                      {.key = "near_mm",
                       .help = "far end of the first slice, millimetres",
                       .fallback = "500",
                       .min = 1,
                       .max = 1000},
                      {.key = "far_m",
                       .help = "near end of the last slice, metres; it reaches to infinity",
                       .fallback = "500",
                       .min = 2,
                       .max = 1000000},
                      {.key = "mean_capacity",
                       .help = "lights a cluster, on average, that the shared list has room for",
                       .fallback = "512",
                       .min = 1,
                       .max = 65536}},
          .plan = plan_clustered};
}

}  // namespace lamp
