// Lamplight's own method: lights look for cells, not cells for lights. One look at the depth buffer, one at the lights;
// survivors are counted and scattered into cells, and each cell's lights are tested exactly against its tiles. Without
// a depth buffer cells are cut into slices of depth, and the result is right at any depth.
// Based on: the count, scan, fill of Blelloch, Prefix Sums and Their Applications (1990); the depth mask of Harada,
// A 2.5D Culling for Forward+, SIGGRAPH Asia (2012). Promise: work grows with lights and output, whatever their
// distribution; lists of any length ascend; what does not fit is counted and walked the long way.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cstddef>
#include <string>
#include <utility>

#include "lamplight/shared/lamplight.h"
#include "lamplight_at_once.h"
#include "lamplight_sizes.h"
#include "methods.h"
#include "parts.h"

namespace lamp {
namespace {

using lamplight::find_threads;
using lamplight::group_threads;
using lamplight::has_small_subgroups;
using lamplight::light_threads;
using lamplight::Sizes;
using lamplight::THREAD_PAIRS;
using lamplight::WORD_LIGHTS;

// Tuned on an H100, blocks and posts, 64k and 1M lights; docs/methods/lamplight.md says what else was tried.
constexpr std::uint32_t SCAN_COLUMNS = 16;
constexpr std::uint32_t SCAN_THREADS = 256;
using shared::PIECE;                              // entries that a work group culls
constexpr std::uint32_t GROUP_HITS = 2;           // for each thread of a group, in shared memory
constexpr std::uint32_t LEAST_SUBGROUP = 4;       // threads, unless the device says so
constexpr std::uint32_t FEW_OF_SUBGROUP = 4;      // lights in view for each, while there are few
constexpr std::uint32_t WANTED_GROUPS = 512;      // of the pass that finds cells with bits
constexpr std::uint32_t CROWDED = 64;             // lights; all pieces of cells of more are shared out, if few
constexpr std::uint32_t PARTS = 2;                // of the rows of a group, for each such piece
constexpr std::uint32_t SHARED_GROUPS = 384;      // that take what is shared out
constexpr std::uint32_t SOFTWARE_GROUPS = 16;     // likewise, where subgroups are small, unless it takes more:
constexpr std::uint32_t SOFTWARE_ROUNDS = 32768;  // of all loops of a thread; llvmpipe ends them after twice as many
constexpr std::uint32_t PIECE_ROUNDS = 500;       // for a piece, besides a word each and a look at the cells
constexpr std::uint64_t MOST_STEPS = 16;  // of a walk in each round of its loop: shading is in the code as often

/// Lights in view of a work group that finds cells, while there are few.
std::uint32_t few_lights(const Problem& problem, std::uint32_t threads) {
  const std::uint32_t subgroup = problem.traits.subgroup_size;
  return parts::divide_up(threads, subgroup) * std::min(FEW_OF_SUBGROUP, subgroup);
}

/// Lights of a work group that finds cells with bits: all lights are spread over WANTED_GROUPS, but none gets fewer
/// than one for each of its subgroups.
std::uint32_t find_share(const Problem& problem, std::uint32_t threads) {
  const std::uint32_t subgroups = parts::divide_up(threads, problem.traits.subgroup_size);
  const std::uint32_t wanted = parts::divide_up(parts::capacity(problem), WANTED_GROUPS);
  return std::clamp(wanted, subgroups, threads);
}

struct Buffers {
  ResourceId totals, tile_depths, cell_depths, seen, matrix, hits, cells, pieces, entries, piece_lists, rows, lists;
};

Buffers add_buffers(Plan& plan, const Problem& problem, const Sizes& s) {
  Buffers b{};
  const bool depth_clears = s.cell_bits && !s.sliced();
  b.totals = plan.add({.name = "totals",
                       .bytes = sizeof(shared::LightTotals),
                       .memory = BufferMemory::counts,
                       .zeroed = !depth_clears,
                       .zeroed_by_pass = depth_clears,
                       .indirect = !s.cell_bits});
  plan.counters = b.totals;
  if (!s.sliced()) {
    b.tile_depths = plan.add({.name = "tile depth ranges", .bytes = s.tiles * sizeof(shared::TileDepths)});
    b.cell_depths = plan.add({.name = "cell depth ranges", .bytes = s.cells * 4});
  }
  if (!s.cell_bits) b.seen = plan.add({.name = "lights in view", .bytes = std::uint64_t{parts::capacity(problem)} * 4});
  const auto of_cells = [&](const char* name, std::uint64_t cell_bytes) {
    // With a depth buffer the pass that looks at depths zeroes them.
    return plan.add({.name = name,
                     .bytes = s.cell_count * cell_bytes,
                     .zeroed = s.sliced(),
                     .zeroed_cells = lamplight::finest_cells(problem, s),
                     .cell_bytes = cell_bytes});
  };
  b.matrix = of_cells(s.cell_bits ? "cell bits" : "cell counts", std::uint64_t{s.blocks} * 4);
  b.cells = of_cells("cells", sizeof(shared::LightCell));
  if (s.cell_bits) {
    b.piece_lists = plan.add({.name = "piece lists", .bytes = std::uint64_t{s.entries} * 4});
  } else {
    // As many hits as entries: each becomes one, and then its place is free.
    b.hits = b.piece_lists = plan.add({.name = "hits", .bytes = std::uint64_t{s.entries} * sizeof(shared::LightHit)});
    b.pieces = plan.add({.name = "pieces", .bytes = std::uint64_t{s.pieces} * sizeof(shared::LightPiece)});
    b.entries = plan.add({.name = "cell lists", .bytes = std::uint64_t{s.entries} * 4});
  }
  b.rows = plan.add(
      {.name = s.bits ? "tile bits" : "tile spans", .bytes = std::uint64_t{s.pieces} * s.cell_rows * s.row_bytes()});
  b.lists = s.bits ? b.rows : plan.add({.name = "tile lists", .bytes = std::uint64_t{s.listed} * 4});
  return b;
}

using Constants = std::vector<std::uint32_t>;

Constants with_slices(Constants constants, const Problem& problem, const Sizes& s) {
  return lamplight::with_slices(std::move(constants), problem, s.cell_slices, s.slices);
}

/// Of cells with lists or with bits.
std::string shader_of(std::string_view name, const Sizes& s) {
  return std::string("methods/lamplight_").append(name).append(s.cell_bits ? "_cell_bits" : "");
}

Pass depth_pass(const Problem& problem, const Sizes& s, const Buffers& b) {
  const std::uint32_t cell_px = s.cell_px();
  const std::uint32_t busy = s.cell_tiles * s.cell_tiles * problem.traits.subgroup_size;  // a tile is a subgroup's
  const std::uint32_t threads =
      lamplight::full_threads(problem, std::clamp(std::min(cell_px * cell_px / 8, busy), 64U, 512U));
  Pass pass{
      .name = "tile depth",
      .shader = shader_of("depth", s),
      .constants = {threads, s.tile_px, s.cell_tiles, lamplight::squares_held(problem), s.block, problem.depth_samples},
      .bindings = {{INPUT_FRAME},
                   {INPUT_DEPTH},
                   {b.tile_depths, Access::write},
                   {b.cells, Access::write},
                   {b.matrix, Access::write},
                   {b.cell_depths, Access::write}},
      .extent = {.cells = {.px = cell_px}},
      .full_subgroups = threads};
  if (s.cell_bits) pass.bindings.push_back({b.totals, Access::write});
  return pass;
}

Pass view_pass(const Problem& problem, const Buffers& b, std::uint32_t threads) {
  return {.name = "lights in view",
          .shader = "methods/lamplight_view",
          .constants = {threads, few_lights(problem, threads)},
          .bindings = {{INPUT_FRAME}, {INPUT_SPHERES}, {b.totals, Access::read_write}, {b.seen, Access::write}},
          .extent = {.lights_per_group = threads},
          .full_subgroups = threads};
}

Pass find_pass(const Problem& problem, const Sizes& s, const Buffers& b, std::uint32_t threads) {
  const std::uint32_t share = s.cell_bits ? find_share(problem, threads) : few_lights(problem, threads);
  Pass pass{.name = "find cells",
            .shader = shader_of(s.sliced() ? "find_sliced" : "find", s),
            .constants = with_slices({threads, s.tile_px, s.cell_tiles, s.cell_grid().layers, share}, problem, s),
            .bindings = {{INPUT_FRAME}, {INPUT_LIGHTS}, {INPUT_SPHERES}, {b.matrix, Access::read_write}},
            .full_subgroups = threads};
  if (s.cell_bits) {
    pass.bindings.push_back({b.cells, Access::read_write});
    pass.extent = {.lights_per_group = share};
  } else {
    pass.constants.insert(pass.constants.end(), {s.block, s.entries, GROUP_HITS * threads});
    pass.bindings.insert(pass.bindings.end(), {{b.totals, Access::read_write}, {b.hits, Access::write}, {b.seen}});
    pass.extent = {.indirect = b.totals, .indirect_offset = offsetof(shared::LightTotals, find_x)};
  }
  if (!s.sliced()) pass.bindings.insert(pass.bindings.end(), {{b.tile_depths}, {b.cell_depths}});
  return pass;
}

Pass scan_pass(const Problem& problem, const Sizes& s, const Buffers& b, std::uint32_t scatter_threads) {
  const std::uint32_t threads = group_threads(problem, SCAN_THREADS);
  return {.name = "scan cells",
          .shader = "methods/lamplight_scan",
          .constants = {threads / SCAN_COLUMNS, s.cell_px(), s.cell_grid().layers, s.block, s.pieces, s.entries,
                        s.cell_rows, scatter_threads, s.cell_rows / s.group_rows},
          .bindings = {{INPUT_FRAME},
                       {b.matrix, Access::read_write},
                       {b.cells, Access::write},
                       {b.pieces, Access::write},
                       {b.totals, Access::read_write}},
          .extent = {.x = 0, .cells = s.cell_grid(), .cells_per_group = SCAN_COLUMNS}};
}

Pass scatter_pass(const Sizes& s, const Buffers& b, std::uint32_t threads) {
  return {.name = "scatter hits",
          .shader = "methods/lamplight_scatter",
          .constants = {threads, s.cell_px(), s.cell_grid().layers, s.block, s.entries},
          .bindings = {{INPUT_FRAME}, {b.hits}, {b.matrix}, {b.totals}, {b.entries, Access::write}},
          .extent = {.indirect = b.totals, .indirect_offset = offsetof(shared::LightTotals, scatter_x)}};
}

/// Groups of the last pass, for each of a cell's row groups, that take what is shared out, where cells have bits.
std::uint32_t sharing_groups(const Problem& problem, const Sizes& s) {
  if (parts::capacity(problem) <= (has_small_subgroups(problem) ? PIECE : CROWDED)) return 1;  // nothing is
  const std::uint32_t row_groups = s.cell_rows / s.group_rows;
  const std::uint64_t most = std::uint64_t{s.cell_count} * parts::divide_up(parts::capacity(problem), PIECE);
  std::uint32_t groups = parts::divide_up(SHARED_GROUPS, row_groups);
  if (has_small_subgroups(problem)) {
    const std::uint32_t rounds = PIECE_ROUNDS + s.blocks / light_threads(problem) + s.cell_count / 32;
    const std::uint32_t of_group = std::max(1U, SOFTWARE_ROUNDS / rounds);
    const auto further = static_cast<std::uint32_t>(std::min<std::uint64_t>(most, s.pieces - s.cell_count));
    groups = std::max(parts::divide_up(SOFTWARE_GROUPS, row_groups), parts::divide_up(further, of_group));
  }
  return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(most * PARTS, 1, groups));
}

/// With bits a group for each cell, and some for crowded ones: that costs less than to have the GPU read how many
/// groups it needs.
Extent lists_extent(const Problem& problem, const Sizes& s, const Buffers& b) {
  if (!s.cell_bits) return {.indirect = b.totals, .indirect_offset = offsetof(shared::LightTotals, pieces)};
  return {
      .x = sharing_groups(problem, s), .y = s.cell_rows / s.group_rows, .cells = s.cell_grid(), .cells_per_group = 1};
}

/// Subgroups of one pass may be smaller than others, but not smaller than this.
std::uint32_t most_subgroups(const Problem& problem, std::uint32_t threads) {
  return parts::divide_up(threads, std::min(LEAST_SUBGROUP, problem.traits.subgroup_size));
}

Pass lists_pass(const Problem& problem, const Sizes& s, const Buffers& b) {
  const bool pruned = problem.options.word("prune") == "pixel";
  const std::uint32_t mark_words = s.group_rows * shared::PIECE_WORDS;
  const std::uint32_t threads = light_threads(problem);
  const std::uint32_t pairs = THREAD_PAIRS * threads;
  // To put lights in order by: sums of each subgroup, or bits of the lights of a block.
  const std::uint32_t order_size = s.cell_bits ? most_subgroups(problem, threads) : parts::divide_up(s.block, 32);
  Pass pass{.name = s.bits ? "tile bits" : "tile lists",
            .shader = shader_of(s.sliced() ? "lists_sliced"
                                : pruned   ? "lists_pruned"
                                           : "lists",
                                s),
            .constants = with_slices(
                {threads, s.tile_px, s.cell_tiles, s.listed, pairs, s.group_rows, mark_words, s.cell_rows,
                 s.bits ? 1U : 0U, parts::further_tests(problem.options), order_size, s.cell_bits ? s.pieces : s.block,
                 s.cell_grid().layers, has_small_subgroups(problem) ? ~0U : CROWDED, PARTS},
                problem, s),
            .bindings = {{INPUT_FRAME},
                         {INPUT_LIGHTS},
                         {INPUT_SPHERES},
                         s.cell_bits ? Binding{b.cells, Access::read_write} : Binding{b.pieces},
                         {b.totals, Access::read_write},
                         {b.rows, Access::write},
                         {b.piece_lists, Access::write},
                         {b.lists, Access::write}},
            .extent = lists_extent(problem, s, b),
            .full_subgroups = threads};
  if (!s.cell_bits) pass.bindings.push_back({b.entries});
  pass.bindings.push_back({b.matrix});
  pass.bindings.push_back(parts::radial_binding(problem, INPUT_SPHERES));
  if (!s.sliced()) pass.bindings.push_back({b.tile_depths});
  if (pruned) pass.bindings.push_back({INPUT_DEPTH});
  return pass;
}

std::vector<Pass> passes_of(const Problem& problem, const Sizes& s, const Buffers& b) {
  const std::uint32_t threads = find_threads(problem);
  std::vector<Pass> passes;
  if (!s.sliced()) passes.push_back(depth_pass(problem, s, b));
  if (!s.cell_bits) passes.push_back(view_pass(problem, b, threads));
  passes.push_back(find_pass(problem, s, b, threads));
  if (!s.cell_bits) {
    passes.push_back(scan_pass(problem, s, b, threads));
    passes.push_back(scatter_pass(s, b, threads));
  }
  passes.push_back(lists_pass(problem, s, b));
  return passes;
}

/// For pictures with finer cells than the largest.
std::vector<FinerPasses> finer_passes(const Problem& problem, const Sizes& s, const Buffers& b) {
  std::vector<FinerPasses> finer;
  for (std::uint32_t tiles = lamplight::LEAST_CELL_TILES; problem.smaller_frames && tiles < s.cell_tiles; tiles *= 2) {
    const Sizes fine = lamplight::with_cell_tiles(s, tiles);
    finer.push_back({.shift = lamplight::log2_of(s.cell_tiles / tiles),
                     .cells = {.px = fine.cell_px()},
                     .most_cells = lamplight::most_cells(tiles, parts::capacity(problem)),
                     .passes = passes_of(problem, fine, b)});
  }
  return finer;
}

bool gathers(const Problem& problem) {
  const std::string_view wanted = problem.options.word("cells");
  return wanted == "gather" || (wanted == "auto" && lamplight::can_gather(problem));
}

/// On a device that ends a pixel's loop before it has walked all lights: as many steps of the walk in each round as it
/// takes. A step may bring none, at a word without a bit or a piece without a light.
void walk_in_steps(LookUp& lookup, const Problem& problem) {
  const std::uint64_t rounds = problem.traits.max_loop_rounds;
  const std::uint64_t lights = parts::capacity(problem);
  if (lights * WALK_ROUNDS <= rounds) return;
  const std::uint64_t idle = lights / WORD_LIGHTS + 1;
  const std::uint64_t steps = std::min(std::bit_ceil((lights + idle) / rounds + 1), MOST_STEPS);
  lookup.name += "_stepped";
  lookup.constants.push_back(static_cast<std::uint32_t>(steps));
  lookup.most_walked = steps * rounds - std::min(steps * rounds, idle);
}

Plan plan_lamplight(const Problem& problem) {
  if (gathers(problem)) return lamplight::plan_at_once(problem);
  const Sizes sizes = lamplight::sizes_of(problem);
  Plan plan;
  plan.cells = sizes.tiles * sizes.slices;
  plan.any_depth = sizes.sliced();
  const Buffers buffers = add_buffers(plan, problem, sizes);
  plan.capacities = {{.option = "mean_cells",
                      .entries = sizes.entries,
                      .per_option = parts::capacity(problem),
                      .needed_offset = offsetof(shared::LightTotals, wanted_pieces),
                      .entries_per_count = PIECE}};
  if (!sizes.bits)
    plan.capacities.push_back({.option = "mean_capacity",
                               .entries = sizes.listed,
                               .per_option = plan.cells,
                               .needed_offset = offsetof(shared::LightTotals, list_entries)});
  plan.passes = passes_of(problem, sizes, buffers);
  plan.finer = finer_passes(problem, sizes, buffers);
  plan.lookup = {.name = sizes.bits ? "cell_bits" : "cell_lists",
                 .constants = with_slices({sizes.tile_px, lamplight::log2_of(sizes.cell_tiles)}, problem, sizes),
                 .bindings = {{INPUT_FRAME}, {buffers.cells}, {buffers.rows}, {buffers.piece_lists}}};
  plan.lookup.constants.insert(plan.lookup.constants.end(), {sizes.cell_bits ? 1U : 0U, plan.finer.empty() ? 0U : 1U});
  if (!sizes.bits) plan.lookup.bindings.push_back({buffers.lists});
  walk_in_steps(plan.lookup, problem);
  return plan;
}

std::optional<Error> check_lamplight(const Problem& problem) {
  if (problem.options.word("depth") == "none" && problem.options.word("prune") == "pixel")
    return Error{"option prune", "pixel looks at the depth buffer, and depth=none does not; expected prune=none"};
  if (problem.options.word("cells") == "gather" && !lamplight::can_gather(problem))
    return Error{
        "option cells",
        "gather is for up to " + std::to_string(PIECE) +
            " lights, a depth buffer, and pictures whose lists take no more than 32 MiB; expected auto, list or bits"};
  return std::nullopt;
}

std::vector<OptionSpec> lamplight_options() {
  static_assert(lamplight::LEAST_TILE_PX == 8);
  return {{.key = "tile", .help = "tile size, pixels", .fallback = "16", .choices = {"8", "16", "32"}},
          {.key = "container",
           .help = "what a tile keeps: a list, or a bit for each light of its cell",
           .fallback = "list",
           .choices = {"list", "bits"}},
          {.key = "cells",
           .help = "how cells get lights: these find them and are kept as a list, or as a bit for every light; gather: "
                   "cells look at all of up to 128; auto: gather, bits while these are small, list",
           .fallback = "auto",
           .choices = {"auto", "list", "bits", "gather"}},
          {.key = "prune",
           .help = "pixel: lights that reach no pixel of a tile are dropped",
           .fallback = "none",
           .choices = {"none", "pixel"}},
          parts::occlusion_option(),
          parts::boxes_option(),
          {.key = "depth",
           .help = "none: tiles are cut into slices, right at any depth, and no depth buffer is read",
           .fallback = "buffer",
           .choices = {"buffer", "none"}},
          {.key = "slices",
           .help = "depth=none: slices of depth",
           .fallback = "24",
           .min = 2,
           .max = lamplight::MOST_SLICES},
          parts::slice_scale_option("scale", "log"),
          parts::slice_near_option(),
          parts::slice_far_option(),
          {.key = "mean_cells",
           .help = "cells a light, on average, that there is room for; 0: none but for two pieces a cell",
           .fallback = "1",
           .min = 0,
           .max = 4096},
          {.key = "mean_capacity",
           .help = "container=list: lights a tile, on average, that the lists have room for; from 32 on, all lights "
                   "where these are few",
           .fallback = "32",
           .min = 1,
           .max = MAX_LIGHTS}};
}

}  // namespace

Method lamplight_method() {
  return {.name = "lamplight",
          .title = "Lamplight: lights look for cells",
          .source = "This project, docs/methods/lamplight.md",
          .summary = "Lights are projected and scattered into cells; each cell tests its few lights exactly.",
          .result = "cell_lists",
          .options = lamplight_options(),
          .plan = plan_lamplight,
          .check = check_lamplight};
}

}  // namespace lamp
