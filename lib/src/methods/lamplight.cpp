// Lamplight's own method: lights look for cells, not cells for lights. One look at the depth buffer, one at the lights;
// survivors are counted and scattered into cells, and each cell's lights are tested exactly against its tiles.
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
constexpr std::uint32_t PIECE = 128;           // entries that a work group culls
constexpr std::uint32_t MARGIN = 32;           // around them, where runs of a block begin and end
constexpr std::uint32_t LEAST_CELL_TILES = 4;  // a side; fewer leave the last pass with groups of few lights
constexpr std::uint32_t MOST_CELL_TILES = 32;  // a side: as many rows as the last pass looks at together
constexpr std::uint32_t GOOD_CELLS = 2304;     // not more where cells can be larger; 4K has 2040
constexpr std::uint32_t WANTED_BLOCKS = 256;   // rows of the matrix
constexpr std::uint32_t LARGEST_BLOCK = 8192;  // lights
constexpr std::uint32_t SMALLEST_BLOCK = 32;   // lights
constexpr std::uint32_t THREADS = 256;
constexpr std::uint32_t GROUP_HITS = 4;  // for each thread of a group, in shared memory
constexpr std::uint32_t LIST_THREADS = 128;
constexpr std::uint32_t PAIRS = 1024;               // of light and tile, in shared memory
constexpr std::uint32_t QUEUE_BYTES = 64 * 24 + 8;  // lights of many cells, in shared memory
constexpr std::uint64_t CELL_PIECES = 2;            // for each cell, besides those of mean_cells
constexpr std::uint64_t MEAN_CAPACITY = 32;         // default of the option
constexpr std::uint64_t LIST_LIGHTS = 4;            // entries for each light that are room as well, within LIST_BUDGET
constexpr std::uint64_t LIST_BUDGET = 5U << 18;     // entries, 5 MiB: what small pictures leave of it is room as well
constexpr std::uint64_t MOST_ENTRIES = 1U << 30;    // an entry's place has 31 bits
static_assert(LARGEST_BLOCK <= 1U << (32 - shared::HIT_CELL_BITS));

/// Every size of the plan.
struct Sizes {
  std::uint32_t tile_px, cell_tiles;
  parts::TileGrid tiles, cells;
  std::uint32_t cell_count;
  std::uint32_t block;   ///< lights
  std::uint32_t blocks;  ///< rows of the count matrix
  std::uint32_t pieces;  ///< of PIECE lights in cells, capacity
  std::uint32_t hits;    ///< pairs of light and cell, capacity
  std::uint32_t listed;  ///< lights in tiles, capacity
};

/// A power of two that the device takes.
std::uint32_t group_threads(const Problem& problem, std::uint32_t wanted) {
  return std::min(wanted, std::bit_floor(problem.traits.max_group_invocations));
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
                   bytes / sizeof(shared::LightSpan) / (s.cell_tiles * s.cell_tiles),
                   bytes / sizeof(shared::LightHit) / PIECE});
}

Sizes sizes_of(const Problem& problem) {
  Sizes s{};
  s.tile_px = problem.options.integer("tile");
  s.tiles = parts::tile_grid(problem, s.tile_px);
  s.cell_tiles = LEAST_CELL_TILES / 2;
  do {
    s.cell_tiles *= 2;
    s.cells = parts::tile_grid(problem, s.tile_px * s.cell_tiles);
  } while (s.cells.count() > GOOD_CELLS && s.cell_tiles < MOST_CELL_TILES);
  s.cell_count = static_cast<std::uint32_t>(s.cells.count());
  const std::uint64_t lights = parts::capacity(problem);
  s.block = block_size(parts::capacity(problem));
  s.blocks = parts::divide_up(parts::capacity(problem), s.block);
  const std::uint64_t room = lights * problem.options.integer("mean_cells");
  s.pieces = static_cast<std::uint32_t>(
      std::min((room + PIECE - 1) / PIECE + CELL_PIECES * s.cell_count, most_pieces(problem, s)));
  const std::uint64_t tiles = s.tiles.count();
  const std::uint64_t left = LIST_BUDGET - std::min(LIST_BUDGET, MEAN_CAPACITY * tiles);
  s.listed = static_cast<std::uint32_t>(
      std::min({tiles * problem.options.integer("mean_capacity") + std::min(LIST_LIGHTS * lights, left), MOST_ENTRIES,
                problem.traits.max_storage_buffer_bytes / 4}));
  return s;
}

struct Buffers {
  ResourceId counters, totals, tile_depths, cell_depths, spheres, seen, matrix, hits, cells, pieces, entries, spans,
      lists;
};

Buffers add_buffers(Plan& plan, const Sizes& s, std::uint64_t lights) {
  Buffers b{};
  b.counters = parts::add_counters(plan);
  b.totals = plan.add({.name = "totals", .bytes = sizeof(shared::LightTotals), .zeroed = true, .indirect = true});
  b.tile_depths = plan.add({.name = "tile depth ranges", .bytes = s.tiles.count() * sizeof(shared::TileDepths)});
  b.cell_depths = plan.add({.name = "cell depth ranges", .bytes = s.cells.count() * 4});
  b.spheres = plan.add({.name = "light bounds", .bytes = lights * sizeof(shared::LightBounds)});
  b.seen = plan.add({.name = "lights in view", .bytes = lights * 4});
  b.matrix = plan.add({.name = "cell counts", .bytes = std::uint64_t{s.blocks} * s.cell_count * 4});
  b.hits = plan.add({.name = "hits", .bytes = std::uint64_t{s.pieces} * PIECE * sizeof(shared::LightHit)});
  b.cells = plan.add({.name = "cells", .bytes = s.cells.count() * sizeof(shared::LightCell)});
  b.pieces = plan.add({.name = "pieces", .bytes = std::uint64_t{s.pieces} * 4});
  b.entries = plan.add({.name = "cell lists", .bytes = std::uint64_t{s.pieces} * PIECE * 4});
  b.spans = plan.add({.name = "tile spans",
                      .bytes = std::uint64_t{s.pieces} * s.cell_tiles * s.cell_tiles * sizeof(shared::LightSpan)});
  b.lists = plan.add({.name = "tile lists", .bytes = std::uint64_t{s.listed} * 4});
  return b;
}

/// Whether all lists together could have 2^32 entries: then a total is looked at before it is added to.
std::uint32_t lists_may_wrap(const Sizes& s) {
  return std::uint64_t{s.pieces} * PIECE * s.cell_tiles * s.cell_tiles >> 32 == 0 ? 0 : 1;
}

std::vector<Pass> passes_of(const Problem& problem, const Sizes& s, const Buffers& b) {
  const std::uint32_t cell_pixels = s.tile_px * s.cell_tiles * s.tile_px * s.cell_tiles;
  // 65 535 groups, all that some devices have, are one short of 16 million lights.
  const bool many_lights = parts::divide_up(parts::capacity(problem), THREADS) > problem.traits.max_groups[0];
  const std::uint32_t threads = group_threads(problem, many_lights ? 2 * THREADS : THREADS);
  const std::uint32_t hits = s.pieces * PIECE;  // as many as entries: each becomes one
  const std::uint32_t group_hits = GROUP_HITS * threads;
  const std::uint32_t run_words = parts::divide_up(s.block, 32);
  const std::uint32_t scan_threads = group_threads(problem, SCAN_THREADS);
  constexpr Access WRITE = Access::write;
  constexpr Access BOTH = Access::read_write;
  return {
      {.name = "tile depth",
       .shader = "methods/lamplight_depth",
       .constants = {group_threads(problem, std::clamp(cell_pixels / 8, 64U, 512U)), s.tile_px, s.cell_tiles, s.block},
       .bindings = {{INPUT_FRAME}, {INPUT_DEPTH}, {b.tile_depths, WRITE}, {b.cell_depths, WRITE}, {b.matrix, WRITE}},
       .extent = {.x = s.cells.width, .y = s.cells.height},
       .shared_bytes = 32},
      {.name = "lights in view",
       .shader = "methods/lamplight_view",
       .constants = {threads},
       .bindings = {{INPUT_FRAME}, {INPUT_LIGHTS}, {b.totals, BOTH}, {b.spheres, WRITE}, {b.seen, WRITE}},
       .extent = {.lights_per_group = threads},
       .shared_bytes = 8},
      {.name = "find cells",
       .shader = "methods/lamplight_find",
       .constants = {threads, s.tile_px, s.cell_tiles, s.cell_count, s.block, hits, group_hits},
       .bindings = {{INPUT_FRAME},
                    {b.tile_depths},
                    {b.cell_depths},
                    {b.spheres},
                    {b.seen},
                    {b.matrix, BOTH},
                    {b.hits, WRITE},
                    {b.totals, BOTH}},
       .extent = {.indirect = b.totals, .indirect_offset = offsetof(shared::LightTotals, find_x)},
       .shared_bytes = group_hits * std::uint32_t{sizeof(shared::LightHit)} + QUEUE_BYTES + 8},
      {.name = "scan cells",
       .shader = "methods/lamplight_scan",
       .constants = {scan_threads / SCAN_COLUMNS, s.cell_count, s.block, PIECE, s.pieces, hits,
                     s.cell_tiles * s.cell_tiles, threads},
       .bindings =
           {{INPUT_FRAME}, {b.matrix, BOTH}, {b.cells, WRITE}, {b.pieces, WRITE}, {b.totals, BOTH}, {b.counters, BOTH}},
       .extent = {.x = parts::divide_up(s.cell_count, SCAN_COLUMNS)},
       .shared_bytes = scan_threads * 4 + SCAN_COLUMNS * 4 + 4},
      {.name = "scatter hits",
       .shader = "methods/lamplight_scatter",
       .constants = {threads, s.cell_count, s.block, hits},
       .bindings = {{b.hits}, {b.matrix}, {b.totals}, {b.entries, WRITE}},
       .extent = {.indirect = b.totals, .indirect_offset = offsetof(shared::LightTotals, scatter_x)}},
      {.name = "tile lists",
       .shader = "methods/lamplight_lists",
       .constants = {group_threads(problem, LIST_THREADS), s.tile_px, s.cell_tiles, s.block, s.cell_count, PIECE,
                     s.listed, PIECE + 2 * MARGIN, run_words, lists_may_wrap(s), PAIRS},
       .bindings = {{INPUT_FRAME},
                    {INPUT_LIGHTS},
                    {b.tile_depths},
                    {b.spheres},
                    {b.cells},
                    {b.pieces},
                    {b.entries},
                    {b.matrix},
                    {b.totals, BOTH},
                    {b.counters, BOTH},
                    {b.spans, WRITE},
                    {b.lists, WRITE},
                    {b.hits, WRITE}},
       .extent = {.indirect = b.totals},
       .shared_bytes = (7 * PIECE + 2 * MARGIN + run_words + PAIRS) * 4 + 32 * 56 + 84}};
}

Plan plan_lamplight(const Problem& problem) {
  const Sizes sizes = sizes_of(problem);
  Plan plan;
  plan.cells = sizes.tiles.count();
  const Buffers buffers = add_buffers(plan, sizes, parts::capacity(problem));
  plan.capacities = {{.option = "mean_cells",
                      .entries = std::uint64_t{sizes.pieces} * PIECE,
                      .per_option = parts::capacity(problem),
                      .needed = buffers.totals,
                      .needed_offset = offsetof(shared::LightTotals, wanted_pieces),
                      .entries_per_count = PIECE},
                     {.option = "mean_capacity",
                      .entries = sizes.listed,
                      .per_option = sizes.tiles.count(),
                      .needed = buffers.totals,
                      .needed_offset = offsetof(shared::LightTotals, list_entries)}};
  plan.passes = passes_of(problem, sizes, buffers);
  plan.lookup = {.name = "cell_lists",
                 .constants = {sizes.tile_px, sizes.cell_tiles},
                 .bindings = {{INPUT_FRAME}, {buffers.cells}, {buffers.spans}, {buffers.lists}, {buffers.hits}}};
  return plan;
}

}  // namespace

Method lamplight_method() {
  return {.name = "lamplight",
          .title = "Lamplight: lights look for cells",
          .source = "This project, docs/methods/lamplight.md",
          .summary = "Lights are projected and scattered into cells; each cell tests its few lights exactly.",
          .result = "cell_lists",
          .options = {{.key = "tile", .help = "tile size, pixels", .fallback = "16", .choices = {"8", "16", "32"}},
                      {.key = "mean_cells",
                       .help = "cells a light, on average, that there is room for",
                       .fallback = "1",
                       .min = 0,
                       .max = 4096},
                      {.key = "mean_capacity",
                       .help = "lights a tile, on average, that the lists have room for",
                       .fallback = "32",
                       .min = 1,
                       .max = 65536}},
          .plan = plan_lamplight};
}

}  // namespace lamp
