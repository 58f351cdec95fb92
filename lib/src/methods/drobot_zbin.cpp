// Z-binning: one flat bit array a tile, no depth; lights are sorted by depth, and a bin of depth names the least and
// the greatest light that reaches into it, so that a pixel walks only the bits between them. Based on: Drobot, Improved
// Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017), Z-binning. Promise: memory O(X Y N / 32 + Z);
// right for any depth of a pixel; nothing can overflow; the same walk every run, by depth and not by index.
// SPDX-License-Identifier: Apache-2.0
#include <bit>

#include "lamplight/shared/slices.h"
#include "light_sort.h"
#include "methods.h"
#include "parts.h"
#include "zbin_host.h"

namespace lamp {
namespace {

/// Every size of the plan.
struct Sizes {
  std::uint32_t tile_px, bins, scale, near_mm, far_m;
  std::uint64_t tiles;
  std::uint64_t lights;   ///< capacity
  std::uint32_t words;    ///< of a tile's bits
  std::uint32_t threads;  ///< of work groups that sort or cull
  bool wide;              ///< bins of two words
};

Sizes sizes_of(const Problem& problem) {
  const std::uint32_t tile_px = problem.options.integer("tile");
  const std::uint32_t capacity = parts::capacity(problem);
  return {.tile_px = tile_px,
          .bins = problem.options.integer("bins"),
          .scale = problem.options.word("bin_scale") == "uniform" ? shared::SLICES_LINEAR : shared::SLICES_LOG,
          .near_mm = problem.options.integer("near_mm"),
          .far_m = problem.options.integer("far_m"),
          .tiles = parts::tile_count(problem, tile_px),
          .lights = capacity,
          .words = parts::divide_up(capacity, 32),
          .threads = parts::cull_threads(problem),
          .wide = capacity > shared::MOST_NARROW_LIGHTS};
}

struct Buffers {
  ResourceId bounds, order, sorted, bins, bits;
};

BufferDesc bin_buffer(const Sizes& s, BufferMemory memory = BufferMemory::device) {
  return {.name = "bins", .bytes = std::uint64_t{s.bins} * (s.wide ? 8 : 4), .memory = memory};
}

Pass gather_pass(const Buffers& b) {
  return {.name = "sort bounds",
          .shader = "methods/zbin_gather",
          .bindings = {{INPUT_FRAME}, {b.bounds}, {b.order}, {b.sorted, Access::write}},
          .extent = {.lights_per_group = 64}};
}

void add_bins(Plan& plan, const Problem& problem, const Sizes& s, const Buffers& b) {
  const std::uint32_t leaves = std::bit_ceil(s.bins);
  const ResourceId tree = plan.add({.name = "bin tree", .bytes = std::uint64_t{leaves} * 2 * 8, .zeroed = true});
  plan.passes.push_back(
      {.name = "mark bins",
       .shader = "methods/zbin_mark",
       .constants = {s.bins, s.scale, s.near_mm, s.far_m, leaves, parts::has_shapes(problem.options) ? 1U : 0U},
       .bindings =
           {{INPUT_FRAME}, {b.sorted}, {tree, Access::read_write}, {b.order}, parts::record_binding(problem, b.sorted)},
       .extent = {.lights_per_group = 64}});
  plan.passes.push_back({.name = "bins",
                         .shader = "methods/zbin_bins",
                         .constants = {s.bins, leaves, s.wide ? 1U : 0U},
                         .bindings = {{tree}, {b.bins, Access::write}},
                         .extent = {.x = parts::divide_up(s.bins, 64)}});
}

/// Sort and bins, as the source has them on the CPU, or on the GPU.
Buffers add_sorted_lights(Plan& plan, const Problem& problem, const Sizes& s) {
  Buffers b{};
  b.bounds = parts::add_light_bounds(plan, problem);
  b.sorted = plan.add({.name = "sorted bounds", .bytes = s.lights * sizeof(shared::LightBounds)});
  if (problem.options.word("sort") == "cpu") {
    b.order = plan.add(parts::order_buffer("light order", s.lights, BufferMemory::upload));
    b.bins = plan.add(bin_buffer(s, BufferMemory::upload));
    plan.passes = {{.name = "sort and bins",
                    .kind = PassKind::host,
                    .constants = {s.bins, s.scale, s.near_mm, s.far_m, s.wide ? 1U : 0U,
                                  parts::has_shapes(problem.options) ? 1U : 0U},
                    .bindings = {{b.order, Access::write}, {b.bins, Access::write}},
                    .host = sort_into_bins,
                    .option = "sort=cpu"},
                   parts::light_bounds_pass(b.bounds),
                   gather_pass(b)};
    return b;
  }
  plan.passes.push_back(parts::light_bounds_pass(b.bounds));
  b.order = parts::add_light_sort(plan, {.by = b.bounds, .lights = s.lights, .threads = s.threads});
  plan.passes.push_back(gather_pass(b));
  b.bins = plan.add(bin_buffer(s));
  add_bins(plan, problem, s, b);
  return b;
}

Plan plan_drobot_zbin(const Problem& problem) {
  const Sizes s = sizes_of(problem);
  Plan plan;
  plan.any_depth = true;
  plan.cells = s.tiles * s.bins;
  plan.ordered = false;
  Buffers b = add_sorted_lights(plan, problem, s);
  b.bits = plan.add({.name = "tile bits", .bytes = s.tiles * s.words * 4});
  plan.passes.push_back({.name = "tile bits",
                         .shader = "methods/zbin_tiles",
                         .constants = {s.threads, s.tile_px, s.words, parts::further_tests(problem.options)},
                         .bindings = {{INPUT_FRAME},
                                      {b.sorted},
                                      {b.bits, Access::write},
                                      {b.order},
                                      parts::radial_binding(problem, b.sorted),
                                      parts::record_binding(problem, b.sorted)},
                         .extent = {.cells = {.px = s.tile_px}}});
  plan.lookup = {.name = parts::walk_lookup(plan, problem, "tile_zbins"),
                 .constants = {s.tile_px, s.words, s.bins, s.scale, s.near_mm, s.far_m, s.wide ? 1U : 0U},
                 .bindings = {{INPUT_FRAME}, {b.bits}, {b.bins}, {b.order}}};
  return plan;
}

}  // namespace

Method drobot_zbin_method() {
  return {
      .name = "drobot-zbin",
      .title = "Drobot, Z-binning",
      .source = "Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017), Z-binning",
      .summary = "Tiles without depth keep bits of lights sorted by depth; a bin of depth names which of them to walk.",
      .result = "tile_zbins",
      .ordered = false,
      .needs_depth = false,
      .any_depth = true,
      .options =
          {{.key = "tile", .help = "tile size, pixels", .fallback = "8", .choices = {"8", "16", "32"}},
           {.key = "bins", .help = "bins of depth", .fallback = "8096", .min = 1, .max = 65536},
           {.key = "bin_scale",
            .help = "bins have the same length, or grow by a constant factor",
            .fallback = "uniform",
            .choices = {"uniform", "log2"}},
           parts::slice_near_option("far end of the first bin, millimetres"),
           parts::slice_far_option("near end of the last bin, metres; it reaches to infinity"),
           parts::occlusion_option(),
           parts::boxes_option(),
           parts::walk_option("scalar-entity"),
           {.key = "sort", .help = "where lights are sorted and binned", .fallback = "gpu", .choices = {"gpu", "cpu"}}},
      .plan = plan_drobot_zbin,
      .check = [](const Problem& problem) { return parts::check_walk(problem.options, parts::Container::bits); }};
}

}  // namespace lamp
