// Lamplight's own method: lights look for cells, not cells for lights. One look at the depth buffer, one at the lights;
// survivors are counted and scattered into cells, and each cell's lights are tested exactly against its tiles.
// Based on: the count, scan, fill of Blelloch, Prefix Sums and Their Applications (1990); the depth mask of Harada,
// A 2.5D Culling for Forward+, SIGGRAPH Asia (2012). Promise: work grows with lights and output, whatever their
// distribution; lists of any length ascend; what does not fit is counted and walked the long way.
// SPDX-License-Identifier: Apache-2.0
#include <bit>

#include "lamplight/shared/lamplight.h"
#include "lamplight/shared/tile.h"
#include "methods.h"
#include "parts.h"

namespace lamp {
namespace {

constexpr std::uint32_t SCAN_COLUMNS = 16;
constexpr std::uint32_t MOST_CELLS = 2304;        // counters of a work group: 9 KiB of shared memory; 4K has 2040 cells
constexpr std::uint32_t WANTED_BLOCKS = 512;      // enough work groups for large GPUs, few enough rows in the matrix
constexpr std::uint32_t LARGEST_BLOCK = 2048;     // lights
constexpr std::uint32_t SMALLEST_BLOCK = 256;     // lights
constexpr std::uint64_t MOST_ENTRIES = 1U << 30;  // an entry's place has 31 bits

/// Every size of the plan.
struct Sizes {
  std::uint32_t tile_px, cell_tiles;
  parts::TileGrid tiles, cells;
  std::uint32_t cell_count;
  std::uint32_t block;    ///< lights
  std::uint32_t blocks;   ///< rows of the count matrix
  std::uint32_t piece;    ///< entries, about
  std::uint32_t longest;  ///< entries of a piece, at most
  std::uint32_t entries;  ///< lights in cells, capacity
  std::uint32_t listed;   ///< lights in tiles, capacity
  std::uint32_t pieces;   ///< at most
};

std::uint32_t shared_bytes_of_lists(std::uint32_t block) { return (block + block / 2) * 8 + 32 * 52 + 16; }

std::uint32_t block_size(const Problem& problem) {
  std::uint32_t block = std::bit_ceil(parts::divide_up(parts::capacity(problem), WANTED_BLOCKS));
  block = std::clamp(block, SMALLEST_BLOCK, LARGEST_BLOCK);
  while (block > SMALLEST_BLOCK && shared_bytes_of_lists(block) > problem.traits.shared_memory_bytes) block /= 2;
  return block;
}

Sizes sizes_of(const Problem& problem) {
  Sizes s{};
  s.tile_px = problem.options.integer("tile");
  s.tiles = parts::tile_grid(problem, s.tile_px);
  s.cell_tiles = 1;
  do {
    s.cell_tiles *= 2;
    s.cells = parts::tile_grid(problem, s.tile_px * s.cell_tiles);
  } while (s.cells.count() > MOST_CELLS);
  s.cell_count = static_cast<std::uint32_t>(s.cells.count());
  const std::uint64_t lights = parts::capacity(problem);
  s.block = block_size(problem);
  s.blocks = parts::divide_up(parts::capacity(problem), s.block);
  s.piece = s.block / 2;
  s.longest = s.block + s.piece;
  const std::uint64_t most = std::min(MOST_ENTRIES, problem.traits.max_storage_buffer_bytes / 4);
  s.entries = static_cast<std::uint32_t>(std::min(
      lights * problem.options.integer("mean_cells") + std::min<std::uint64_t>(lights, 64) * s.cell_count, most));
  s.listed = static_cast<std::uint32_t>(std::min(
      lights + s.tiles.count() * std::min<std::uint64_t>(lights, problem.options.integer("mean_capacity")), most));
  s.pieces = s.cell_count + s.entries / s.piece;
  return s;
}

struct Buffers {
  ResourceId counters, totals, ranges, cell_depths, spheres, rectangles, lights, survivors, matrix, cells, pieces,
      entries, spans, lists;
};

Buffers add_buffers(Plan& plan, const Sizes& s) {
  const std::uint64_t slots = std::uint64_t{s.blocks} * s.block;
  Buffers b{};
  b.counters = parts::add_counters(plan);
  b.totals = plan.add({.name = "totals", .bytes = sizeof(shared::LightTotals), .zeroed = true, .indirect = true});
  b.ranges = plan.add({.name = "tile depth ranges", .bytes = s.tiles.count() * sizeof(shared::TileRanges)});
  b.cell_depths = plan.add({.name = "cell depth ranges", .bytes = s.cells.count() * 8});
  b.spheres = plan.add({.name = "light bounds", .bytes = slots * sizeof(shared::LightBounds)});
  b.rectangles = plan.add({.name = "light rectangles", .bytes = slots * 8});
  b.lights = plan.add({.name = "light indices", .bytes = slots * 4});
  b.survivors = plan.add({.name = "lights in view", .bytes = std::uint64_t{s.blocks} * 4});
  b.matrix = plan.add({.name = "cell counts", .bytes = std::uint64_t{s.blocks} * s.cell_count * 4});
  b.cells = plan.add({.name = "cells", .bytes = s.cells.count() * sizeof(shared::LightCell)});
  b.pieces = plan.add({.name = "pieces", .bytes = std::uint64_t{s.pieces} * sizeof(shared::LightPiece)});
  b.entries = plan.add({.name = "cell lists", .bytes = std::uint64_t{s.entries} * 4});
  b.spans = plan.add({.name = "tile spans",
                      .bytes = std::uint64_t{s.pieces} * s.cell_tiles * s.cell_tiles * sizeof(shared::LightSpan)});
  b.lists = plan.add({.name = "tile lists", .bytes = std::uint64_t{s.listed} * 4});
  return b;
}

/// A power of two that the device takes.
std::uint32_t group_threads(const Problem& problem, std::uint32_t wanted) {
  return std::min(wanted, std::bit_floor(problem.traits.max_group_invocations));
}

std::vector<Pass> passes_of(const Problem& problem, const Sizes& s, const Buffers& b) {
  const std::uint32_t cell_pixels = s.tile_px * s.cell_tiles * s.tile_px * s.cell_tiles;
  const std::uint32_t block_threads = group_threads(problem, std::min(s.block, 512U));
  const Extent one_group_a_cell{.x = s.cells.width, .y = s.cells.height};
  const Extent one_group_a_block{.lights_per_group = s.block};
  constexpr Access WRITE = Access::write;
  constexpr Access BOTH = Access::read_write;
  return {
      {.name = "tile depth",
       .shader = "methods/lamplight_depth",
       .constants = {group_threads(problem, std::clamp(cell_pixels / 8, 64U, 512U)), s.tile_px, s.cell_tiles},
       .bindings = {{INPUT_FRAME}, {INPUT_DEPTH}, {b.ranges, WRITE}, {b.cell_depths, WRITE}},
       .extent = one_group_a_cell,
       .shared_bytes = 32},
      {.name = "project lights",
       .shader = "methods/lamplight_project",
       .constants = {block_threads, s.tile_px, s.cell_tiles, s.cell_count, s.block},
       .bindings = {{INPUT_FRAME},
                    {INPUT_LIGHTS},
                    {b.ranges},
                    {b.cell_depths},
                    {b.spheres, WRITE},
                    {b.rectangles, WRITE},
                    {b.lights, WRITE},
                    {b.survivors, WRITE},
                    {b.matrix, WRITE}},
       .extent = one_group_a_block,
       .shared_bytes = s.cell_count * 4 + 160},
      {.name = "scan cells",
       .shader = "methods/lamplight_scan",
       .constants = {s.cell_count, s.block, s.piece, s.entries, s.cell_tiles * s.cell_tiles},
       .bindings =
           {{INPUT_FRAME}, {b.matrix, BOTH}, {b.cells, WRITE}, {b.pieces, WRITE}, {b.totals, BOTH}, {b.counters, BOTH}},
       .extent = {.x = parts::divide_up(s.cell_count, SCAN_COLUMNS)},
       .shared_bytes = 16 * 16 * 4 + 3 * 64},
      {.name = "scatter lights",
       .shader = "methods/lamplight_scatter",
       .constants = {block_threads, s.tile_px, s.cell_tiles, s.cell_count, s.block, s.entries},
       .bindings =
           {{INPUT_FRAME}, {b.cell_depths}, {b.spheres}, {b.rectangles}, {b.survivors}, {b.matrix}, {b.entries, WRITE}},
       .extent = one_group_a_block,
       .shared_bytes = s.cell_count * 4},
      {.name = "tile lists",
       .shader = "methods/lamplight_lists",
       .constants = {group_threads(problem, 256), s.tile_px, s.cell_tiles, s.longest, s.listed},
       .bindings = {{INPUT_FRAME},
                    {INPUT_LIGHTS},
                    {b.ranges},
                    {b.spheres},
                    {b.rectangles},
                    {b.lights},
                    {b.cells},
                    {b.pieces},
                    {b.entries, BOTH},
                    {b.totals, BOTH},
                    {b.counters, BOTH},
                    {b.spans, WRITE},
                    {b.lists, WRITE}},
       .extent = {.indirect = b.totals},
       .shared_bytes = shared_bytes_of_lists(s.block)}};
}

Plan plan_lamplight(const Problem& problem) {
  const Sizes sizes = sizes_of(problem);
  Plan plan;
  plan.cells = sizes.tiles.count();
  const Buffers buffers = add_buffers(plan, sizes);
  plan.passes = passes_of(problem, sizes, buffers);
  plan.lookup = {.name = "cell_lists",
                 .constants = {sizes.tile_px, sizes.cell_tiles},
                 .bindings = {{INPUT_FRAME}, {buffers.cells}, {buffers.spans}, {buffers.lists}, {buffers.entries}}};
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
                       .fallback = "4",
                       .min = 1,
                       .max = 4096},
                      {.key = "mean_capacity",
                       .help = "lights a tile, on average, that the lists have room for",
                       .fallback = "64",
                       .min = 1,
                       .max = 65536}},
          .plan = plan_lamplight};
}

}  // namespace lamp
