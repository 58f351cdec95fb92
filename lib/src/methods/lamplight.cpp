// Lamplight's own method: lights look for cells, not cells for lights. One look at the depth buffer, one at the lights;
// survivors are counted and scattered into cells, and each cell's lights are tested exactly against its tiles. Without
// a depth buffer cells are cut into slices of depth, and the result is right at any depth.
// Based on: the count, scan, fill of Blelloch, Prefix Sums and Their Applications (1990); the depth mask of Harada,
// A 2.5D Culling for Forward+, SIGGRAPH Asia (2012). Promise: work grows with lights and output, whatever their
// distribution; lists of any length ascend; what does not fit is counted and walked the long way.
// SPDX-License-Identifier: Apache-2.0
#include <bit>
#include <cstddef>

#include "lamplight/shared/lamplight.h"
#include "methods.h"
#include "parts.h"

namespace lamp {
namespace {

// Tuned on an H100, blocks and posts, 64k and 1M lights; docs/methods/lamplight.md says what else was tried.
constexpr std::uint32_t SCAN_COLUMNS = 16;
constexpr std::uint32_t SCAN_THREADS = 256;
using shared::PIECE;                           // entries that a work group culls
constexpr std::uint32_t MARGIN = 32;           // around them, where runs of a block begin and end
constexpr std::uint32_t GROUP_ROWS = 16;       // of a cell that a work group looks at
constexpr std::uint32_t CELL_SLICES = 4;       // without depth buffer
constexpr std::uint32_t LEAST_CELL_TILES = 4;  // a side; fewer leave the last pass with groups of few lights
constexpr std::uint32_t MOST_CELL_TILES = 32;  // a side
constexpr std::uint32_t GOOD_CELLS = 2304;     // not more where cells can be larger; 4K has 2040
constexpr std::uint32_t FEW_CELLS = 576;       // likewise, for at most SPARSE_LIGHTS
constexpr std::uint32_t SPARSE_LIGHTS = 1U << 17;
constexpr std::uint32_t WANTED_BLOCKS = 256;   // rows of the matrix
constexpr std::uint32_t LARGEST_BLOCK = 8192;  // lights
constexpr std::uint32_t SMALLEST_BLOCK = 32;   // lights
constexpr std::uint32_t THREADS = 256;
constexpr std::uint32_t GROUP_HITS = 2;             // for each thread of a group, in shared memory
constexpr std::uint32_t GROUP_SUBGROUPS = 8;        // more of them than of their lights cost a software device its time
constexpr std::uint32_t FEW_OF_SUBGROUP = 4;        // lights in view for each, while there are few
constexpr std::uint32_t THREAD_PAIRS = 2;           // of light and row for each thread of it, in shared memory
constexpr std::uint32_t QUEUE_BYTES = 32 * 24 + 8;  // lights of many cells, in shared memory
constexpr std::uint64_t CELL_PIECES = 2;            // for each cell, besides those of mean_cells
constexpr std::uint64_t FEW_PIECES = 1024;          // as many instead, unless all lights in all cells take fewer
constexpr std::uint64_t MEAN_CAPACITY = 32;         // default of the option
constexpr std::uint64_t LIST_LIGHTS = 4;            // entries for each light that are room as well, within LIST_BUDGET
constexpr std::uint64_t LIST_BUDGET = 5U << 18;     // entries, 5 MiB: what small pictures leave of it is room as well
constexpr std::uint64_t MOST_ENTRIES = 1U << 30;    // an entry's place has 31 bits
static_assert(LARGEST_BLOCK <= 1U << (32 - shared::HIT_CELL_BITS));

/// Every size of the plan.
struct Sizes {
  std::uint32_t tile_px, cell_tiles;
  std::uint32_t slices, cell_slices;  ///< of depth; 1 with a depth buffer
  parts::TileGrid tiles, cells;       ///< of a slice, of a layer
  std::uint32_t cell_count;           ///< of all layers
  std::uint32_t cell_rows;            ///< tiles times slices
  std::uint32_t group_rows;           ///< of them, for a work group of the last pass
  bool bits;                          ///< the container
  std::uint32_t block;                ///< lights
  std::uint32_t blocks;               ///< rows of the count matrix
  std::uint32_t pieces;               ///< of PIECE lights in cells, capacity
  std::uint32_t hits;                 ///< pairs of light and cell, capacity
  std::uint32_t listed;               ///< lights in lists, capacity; 0 of bits

  [[nodiscard]] bool sliced() const { return slices > 1; }
  /// What a row keeps of a piece: a span of the lists, or bits.
  [[nodiscard]] std::uint64_t row_bytes() const { return bits ? shared::PIECE_WORDS * 4 : sizeof(shared::LightSpan); }
};

/// A power of two that the device takes.
std::uint32_t group_threads(const Problem& problem, std::uint32_t wanted) {
  return std::min(wanted, std::bit_floor(problem.traits.max_group_invocations));
}

/// Of a pass whose subgroups take lights of their own: GROUP_SUBGROUPS where subgroups are small.
std::uint32_t light_threads(const Problem& problem) {
  return group_threads(problem, std::min(THREADS, GROUP_SUBGROUPS * problem.traits.subgroup_size));
}

/// Lights in view of a work group that finds cells, while there are few.
std::uint32_t few_lights(const Problem& problem, std::uint32_t threads) {
  const std::uint32_t subgroup = problem.traits.subgroup_size;
  return parts::divide_up(threads, subgroup) * std::min(FEW_OF_SUBGROUP, subgroup);
}

std::uint32_t block_size(std::uint32_t lights) {
  const std::uint32_t wanted = parts::divide_up(parts::divide_up(lights, WANTED_BLOCKS), SMALLEST_BLOCK);
  return std::clamp(wanted * SMALLEST_BLOCK, SMALLEST_BLOCK, LARGEST_BLOCK);
}

/// As every limit of the device allows: one work group each in the last pass and a span a tile; PIECE hits.
std::uint64_t most_pieces(const Problem& problem, const Sizes& s) {
  const std::uint64_t bytes = problem.traits.max_storage_buffer_bytes;
  const std::uint64_t groups = problem.traits.max_groups[0];
  return std::min({MOST_ENTRIES / PIECE, groups, groups * group_threads(problem, THREADS) / PIECE,
                   bytes / s.row_bytes() / s.cell_rows, bytes / sizeof(shared::LightHit) / PIECE});
}

/// With mean_cells=0 two a cell and no more.
std::uint64_t wanted_pieces(const Problem& problem, const Sizes& s) {
  const std::uint64_t lights = parts::capacity(problem);
  const std::uint64_t room = lights * problem.options.integer("mean_cells");
  const std::uint64_t all = s.cell_count * ((lights + PIECE - 1) / PIECE);
  const std::uint64_t few = room == 0 ? 0 : std::min(FEW_PIECES, all);
  return (room + PIECE - 1) / PIECE + std::max(CELL_PIECES * s.cell_count, few);
}

/// Tiles, slices, and cells of them.
Sizes grid_of(const Problem& problem) {
  const Options& o = problem.options;
  Sizes s{.tile_px = o.integer("tile"), .cell_tiles = LEAST_CELL_TILES / 2, .slices = 1, .cell_slices = 1};
  if (o.word("depth") == "none") {
    s.slices = o.integer("slices");
    s.cell_slices = CELL_SLICES;
  }
  s.tiles = parts::tile_grid(problem, s.tile_px);
  const std::uint32_t good_cells = parts::capacity(problem) <= SPARSE_LIGHTS ? FEW_CELLS : GOOD_CELLS;
  do {
    s.cell_tiles *= 2;
    s.cells = parts::tile_grid(problem, s.tile_px * s.cell_tiles);
  } while (s.cells.count() > good_cells && s.cell_tiles < MOST_CELL_TILES);
  s.cell_count = static_cast<std::uint32_t>(s.cells.count()) * parts::divide_up(s.slices, s.cell_slices);
  s.cell_rows = s.cell_tiles * s.cell_tiles * s.cell_slices;
  s.group_rows = std::max(GROUP_ROWS, s.cell_tiles);
  s.bits = o.word("container") == "bits";
  return s;
}

Sizes sizes_of(const Problem& problem) {
  Sizes s = grid_of(problem);
  const std::uint64_t lights = parts::capacity(problem);
  s.block = block_size(parts::capacity(problem));
  s.blocks = parts::divide_up(parts::capacity(problem), s.block);
  s.pieces = static_cast<std::uint32_t>(std::min(wanted_pieces(problem, s), most_pieces(problem, s)));
  s.hits = s.pieces * PIECE;  // as many as entries: each becomes one
  if (s.bits) return s;
  const std::uint64_t rows = s.tiles.count() * s.slices;
  const std::uint64_t left = LIST_BUDGET - std::min(LIST_BUDGET, MEAN_CAPACITY * rows);
  s.listed = static_cast<std::uint32_t>(
      std::min({rows * problem.options.integer("mean_capacity") + std::min(LIST_LIGHTS * lights, left), MOST_ENTRIES,
                problem.traits.max_storage_buffer_bytes / 4}));
  return s;
}

struct Buffers {
  ResourceId totals, tile_depths, cell_depths, seen, matrix, hits, cells, pieces, entries, rows, lists;
};

Buffers add_buffers(Plan& plan, const Sizes& s, std::uint64_t lights) {
  Buffers b{};
  b.totals = plan.add({.name = "totals", .bytes = sizeof(shared::LightTotals), .zeroed = true, .indirect = true});
  plan.counters = b.totals;
  if (!s.sliced()) {
    b.tile_depths = plan.add({.name = "tile depth ranges", .bytes = s.tiles.count() * sizeof(shared::TileDepths)});
    b.cell_depths = plan.add({.name = "cell depth ranges", .bytes = s.cells.count() * 4});
  }
  b.seen = plan.add({.name = "lights in view", .bytes = lights * 4});
  const std::uint64_t matrix_bytes = std::uint64_t{s.blocks} * s.cell_count * 4;
  b.matrix = plan.add({.name = "cell counts", .bytes = matrix_bytes, .zeroed = s.sliced()});
  b.hits = plan.add({.name = "hits", .bytes = std::uint64_t{s.hits} * sizeof(shared::LightHit)});
  b.cells = plan.add({.name = "cells", .bytes = std::uint64_t{s.cell_count} * sizeof(shared::LightCell)});
  b.pieces = plan.add({.name = "pieces", .bytes = std::uint64_t{s.pieces} * sizeof(shared::LightPiece)});
  b.entries = plan.add({.name = "cell lists", .bytes = std::uint64_t{s.hits} * 4});
  b.rows = plan.add(
      {.name = s.bits ? "tile bits" : "tile spans", .bytes = std::uint64_t{s.pieces} * s.cell_rows * s.row_bytes()});
  b.lists = s.bits ? b.rows : plan.add({.name = "tile lists", .bytes = std::uint64_t{s.listed} * 4});
  return b;
}

/// Whether all lists together could have 2^32 entries: then a total is looked at before it is added to.
std::uint32_t lists_may_wrap(const Sizes& s) { return std::uint64_t{s.hits} * s.cell_rows >> 32 == 0 ? 0 : 1; }

using Constants = std::vector<std::uint32_t>;

/// How depth is sliced, after the other constants of a pass or look-up.
Constants with_slices(Constants constants, const Problem& problem, const Sizes& s) {
  const Options& o = problem.options;
  constants.insert(constants.end(), {s.cell_slices, s.slices, parts::slice_scale(o.word("scale")), o.integer("near_mm"),
                                     o.integer("far_m")});
  return constants;
}

Pass depth_pass(const Problem& problem, const Sizes& s, const Buffers& b) {
  const std::uint32_t cell_px = s.tile_px * s.cell_tiles;
  const std::uint32_t threads = group_threads(problem, std::clamp(cell_px * cell_px / 8, 64U, 512U));
  return {.name = "tile depth",
          .shader = "methods/lamplight_depth",
          .constants = {threads, s.tile_px, s.cell_tiles, s.block},
          .bindings = {{INPUT_FRAME},
                       {INPUT_DEPTH},
                       {b.tile_depths, Access::write},
                       {b.cell_depths, Access::write},
                       {b.matrix, Access::write}},
          .extent = {.x = s.cells.width, .y = s.cells.height},
          .shared_bytes = 32};
}

Pass view_pass(const Problem& problem, const Buffers& b, std::uint32_t threads) {
  return {.name = "lights in view",
          .shader = "methods/lamplight_view",
          .constants = {threads, few_lights(problem, threads)},
          .bindings = {{INPUT_FRAME}, {INPUT_SPHERES}, {b.totals, Access::read_write}, {b.seen, Access::write}},
          .extent = {.lights_per_group = threads},
          .shared_bytes = 8};
}

Pass find_pass(const Problem& problem, const Sizes& s, const Buffers& b, std::uint32_t threads) {
  const std::uint32_t group_hits = GROUP_HITS * threads;
  Pass pass{.name = "find cells",
            .shader = s.sliced() ? "methods/lamplight_find_sliced" : "methods/lamplight_find",
            .constants = with_slices({threads, s.tile_px, s.cell_tiles, s.cell_count, s.block, s.hits, group_hits,
                                      few_lights(problem, threads)},
                                     problem, s),
            .bindings = {{INPUT_FRAME},
                         {INPUT_LIGHTS},
                         {INPUT_SPHERES},
                         {b.seen},
                         {b.matrix, Access::read_write},
                         {b.hits, Access::write},
                         {b.totals, Access::read_write}},
            .extent = {.indirect = b.totals, .indirect_offset = offsetof(shared::LightTotals, find_x)},
            .shared_bytes = group_hits * std::uint32_t{sizeof(shared::LightHit)} + QUEUE_BYTES + 8};
  if (!s.sliced()) pass.bindings.insert(pass.bindings.end(), {{b.tile_depths}, {b.cell_depths}});
  return pass;
}

Pass scan_pass(const Problem& problem, const Sizes& s, const Buffers& b, std::uint32_t scatter_threads) {
  const std::uint32_t threads = group_threads(problem, SCAN_THREADS);
  return {.name = "scan cells",
          .shader = "methods/lamplight_scan",
          .constants = {threads / SCAN_COLUMNS, s.cell_count, s.block, s.pieces, s.hits, s.cell_rows, scatter_threads,
                        s.cell_rows / s.group_rows},
          .bindings = {{INPUT_FRAME},
                       {b.matrix, Access::read_write},
                       {b.cells, Access::write},
                       {b.pieces, Access::write},
                       {b.totals, Access::read_write}},
          .extent = {.x = parts::divide_up(s.cell_count, SCAN_COLUMNS)},
          .shared_bytes = threads * 4 + SCAN_COLUMNS * 4 + 4};
}

Pass scatter_pass(const Sizes& s, const Buffers& b, std::uint32_t threads) {
  return {.name = "scatter hits",
          .shader = "methods/lamplight_scatter",
          .constants = {threads, s.cell_count, s.block, s.hits},
          .bindings = {{b.hits}, {b.matrix}, {b.totals}, {b.entries, Access::write}},
          .extent = {.indirect = b.totals, .indirect_offset = offsetof(shared::LightTotals, scatter_x)}};
}

Pass lists_pass(const Problem& problem, const Sizes& s, const Buffers& b) {
  const bool pruned = problem.options.word("prune") == "pixel";
  const std::uint32_t run_words = parts::divide_up(s.block, 32);
  const std::uint32_t mark_words = s.group_rows * shared::PIECE_WORDS;
  const std::uint32_t threads = light_threads(problem);
  const std::uint32_t pairs = THREAD_PAIRS * threads;
  Pass pass{
      .name = s.bits ? "tile bits" : "tile lists",
      .shader = s.sliced() ? "methods/lamplight_lists_sliced"
                : pruned   ? "methods/lamplight_lists_pruned"
                           : "methods/lamplight_lists",
      .constants = with_slices({threads, s.tile_px, s.cell_tiles, s.block, s.cell_count, s.listed, run_words,
                                lists_may_wrap(s), pairs, s.group_rows, mark_words, s.cell_rows, s.bits ? 1U : 0U},
                               problem, s),
      .bindings = {{INPUT_FRAME},
                   {INPUT_LIGHTS},
                   {INPUT_SPHERES},
                   {b.pieces},
                   {b.entries},
                   {b.matrix},
                   {b.totals, Access::read_write},
                   {b.rows, Access::write},
                   {b.hits, Access::write},  // free by now: lists of the pieces
                   {b.lists, Access::write}},
      .extent = {.indirect = b.totals, .indirect_offset = offsetof(shared::LightTotals, pieces)},
      .shared_bytes = (6 * PIECE + 2 * MARGIN + run_words + pairs + mark_words) * 4 + s.group_rows * 72 + 80};
  if (!s.sliced()) pass.bindings.push_back({b.tile_depths});
  if (pruned) pass.bindings.push_back({INPUT_DEPTH});
  return pass;
}

std::vector<Pass> passes_of(const Problem& problem, const Sizes& s, const Buffers& b) {
  // 65 535 groups, all that some devices have, are one short of 16 million lights.
  const bool many_lights = parts::divide_up(parts::capacity(problem), THREADS) > problem.traits.max_groups[0];
  const std::uint32_t threads = group_threads(problem, many_lights ? 2 * THREADS : THREADS);
  std::vector<Pass> passes;
  if (!s.sliced()) passes.push_back(depth_pass(problem, s, b));
  passes.push_back(view_pass(problem, b, threads));
  passes.push_back(find_pass(problem, s, b, threads));
  passes.push_back(scan_pass(problem, s, b, threads));
  passes.push_back(scatter_pass(s, b, threads));
  passes.push_back(lists_pass(problem, s, b));
  return passes;
}

Plan plan_lamplight(const Problem& problem) {
  const Sizes sizes = sizes_of(problem);
  Plan plan;
  plan.cells = sizes.tiles.count() * sizes.slices;
  plan.any_depth = sizes.sliced();
  const Buffers buffers = add_buffers(plan, sizes, parts::capacity(problem));
  plan.capacities = {{.option = "mean_cells",
                      .entries = sizes.hits,
                      .per_option = parts::capacity(problem),
                      .needed = buffers.totals,
                      .needed_offset = offsetof(shared::LightTotals, wanted_pieces),
                      .entries_per_count = PIECE}};
  if (!sizes.bits)
    plan.capacities.push_back({.option = "mean_capacity",
                               .entries = sizes.listed,
                               .per_option = plan.cells,
                               .needed = buffers.totals,
                               .needed_offset = offsetof(shared::LightTotals, list_entries)});
  plan.passes = passes_of(problem, sizes, buffers);
  plan.lookup = {.name = sizes.bits ? "cell_bits" : "cell_lists",
                 .constants = with_slices({sizes.tile_px, sizes.cell_tiles}, problem, sizes),
                 .bindings = {{INPUT_FRAME}, {buffers.cells}, {buffers.rows}, {buffers.hits}}};
  if (!sizes.bits) plan.lookup.bindings.push_back({buffers.lists});
  return plan;
}

std::optional<Error> check_lamplight(const Problem& problem) {
  if (problem.options.word("depth") == "none" && problem.options.word("prune") == "pixel")
    return Error{"option prune", "pixel looks at the depth buffer, and depth=none does not; expected prune=none"};
  return std::nullopt;
}

std::vector<OptionSpec> lamplight_options() {
  return {{.key = "tile", .help = "tile size, pixels", .fallback = "16", .choices = {"8", "16", "32"}},
          {.key = "container",
           .help = "what a tile keeps: a list, or a bit for each light of its cell",
           .fallback = "list",
           .choices = {"list", "bits"}},
          {.key = "prune",
           .help = "pixel: lights that reach no pixel of a tile are dropped",
           .fallback = "none",
           .choices = {"none", "pixel"}},
          {.key = "depth",
           .help = "none: tiles are cut into slices, right at any depth, and no depth buffer is read",
           .fallback = "buffer",
           .choices = {"buffer", "none"}},
          {.key = "slices", .help = "depth=none: slices of depth", .fallback = "24", .min = 2, .max = 32},
          parts::slice_scale_option("scale", "log"),
          parts::slice_near_option(),
          parts::slice_far_option(),
          {.key = "mean_cells",
           .help = "cells a light, on average, that there is room for; 0: none but for two pieces a cell",
           .fallback = "1",
           .min = 0,
           .max = 4096},
          {.key = "mean_capacity",
           .help = "container=list: lights a tile, on average, that the lists have room for",
           .fallback = "32",
           .min = 1,
           .max = 65536}};
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
