// Tiled culling into flat bit arrays: bit N of a tile says that light N may reach it.
// Based on: Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017), flat bit arrays;
// the cull itself is Stewart's (GPU Pro 7, 1.3).
// Promise: no list can overflow; the order is the lights' order.
// SPDX-License-Identifier: Apache-2.0
#include "methods.h"
#include "parts.h"

namespace lamp {
namespace {

Plan plan_tiled_bits(const Problem& problem) {
  const std::uint32_t tile_px = problem.options.integer("tile");
  const parts::TileGrid tiles = parts::tile_grid(problem, tile_px);
  const std::uint32_t threads = parts::cull_threads(problem);
  const std::uint32_t words = parts::divide_up(parts::capacity(problem), 32);

  Plan plan;
  plan.cells = tiles.count();
  const ResourceId bounds = parts::add_light_bounds(plan, problem);
  const ResourceId bits =
      plan.add({.name = "tile bits", .bytes = tiles.count() * words * sizeof(std::uint32_t)});
  plan.passes = {parts::light_bounds_pass(bounds),
                 {.name = "tiled cull to bits",
                  .shader = "methods/tiled_bits",
                  .constants = {threads, tile_px, words},
                  .bindings = {{INPUT_FRAME}, {INPUT_DEPTH}, {bounds}, {bits, Access::write}},
                  .extent = {.x = tiles.width, .y = tiles.height}}};
  plan.lookup = {.name = "tile_bits", .constants = {tile_px, words}, .bindings = {{INPUT_FRAME}, {bits}}};
  return plan;
}

}  // namespace

Method tiled_bits_method() {
  return {.name = "tiled-bits",
          .title = "Tiled culling, flat bit arrays",
          .source = "Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017)",
          .summary = "The tiled cull, but a tile keeps one bit a light instead of a list.",
          .result = "tile_bits",
          .options = {{.key = "tile", .help = "tile size, pixels", .fallback = "16", .choices = {"8", "16", "32"}}},
          .plan = plan_tiled_bits};
}

}  // namespace lamp
