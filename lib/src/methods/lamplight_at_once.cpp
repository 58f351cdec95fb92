// Implements lamplight_at_once.h. Promise: nothing can overflow.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight_at_once.h"

#include <algorithm>

#include "lamplight/shared/lamplight.h"
#include "lamplight_sizes.h"

namespace lamp::lamplight {
namespace {

using shared::PIECE;
// Measured on an H200, blocks, 16 to 128 lights.
constexpr std::uint32_t FEW_TILES = 1400;  // a work group each: with fewer groups much of a large device is idle
constexpr std::uint32_t FEW_TILES_THREADS = 64;
constexpr std::uint32_t CELL_TILES = 4;  // a side, of more tiles
constexpr std::uint64_t MOST_LIST_BYTES = 32U << 20;

struct Grid {
  std::uint64_t tiles, cells;
  std::uint32_t tile_px, cell_tiles, threads;
  bool has_finer;  ///< smaller pictures have a cell for each of at most FEW_TILES

  [[nodiscard]] std::uint32_t cell_px() const { return tile_px * cell_tiles; }
  [[nodiscard]] std::uint32_t cell_rows() const { return cell_tiles * cell_tiles; }
  [[nodiscard]] std::uint64_t rows() const { return cells * cell_rows(); }
  /// Of a picture of any size.
  [[nodiscard]] std::uint64_t most_cells() const {
    return has_finer ? std::max<std::uint64_t>(cells, FEW_TILES) : cells;
  }
};

/// A cell for each tile.
Grid of_tiles(const Problem& problem, Grid grid) {
  grid.cell_tiles = 1;
  grid.cells = grid.tiles;
  grid.threads = full_threads(problem, FEW_TILES_THREADS);
  grid.has_finer = false;
  return grid;
}

Grid grid_of(const Problem& problem) {
  Grid grid{.tile_px = problem.options.integer("tile"), .cell_tiles = CELL_TILES, .threads = light_threads(problem)};
  grid.tiles = parts::tile_count(problem, grid.tile_px);
  // A software device takes longer for more groups.
  const bool may_be_finer = !has_small_subgroups(problem);
  if (grid.tiles <= FEW_TILES && may_be_finer) return of_tiles(problem, grid);
  grid.cells = parts::tile_count(problem, grid.cell_px());
  grid.has_finer = may_be_finer && problem.smaller_frames;
  return grid;
}

std::uint64_t list_bytes(const Problem& problem, const Grid& grid) {
  return grid.rows() * std::max(1U, parts::capacity(problem)) * 4;
}

Pass pass_of(const Problem& problem, const Grid& grid, std::vector<Binding> bindings) {
  const bool bits = problem.options.word("container") == "bits";
  const bool pruned = problem.options.word("prune") == "pixel";
  const std::uint32_t lights = std::max(1U, parts::capacity(problem));
  const std::uint32_t pairs = THREAD_PAIRS * grid.threads;
  const std::uint32_t mark_words = grid.cell_rows() * shared::PIECE_WORDS;
  if (pruned) bindings.push_back({INPUT_DEPTH});
  return {
      .name = bits ? "tile bits" : "tile lists",
      .shader = pruned ? "methods/lamplight_at_once_pruned" : "methods/lamplight_at_once",
      .constants = {grid.threads, grid.tile_px, grid.cell_tiles, squares_held(problem), lights, pairs, grid.cell_rows(),
                    mark_words, bits ? 1U : 0U, problem.depth_samples, parts::further_tests(problem.options)},
      .bindings = std::move(bindings),
      .extent = {.cells = {.px = grid.cell_px()}},
      .full_subgroups = grid.threads};
}

}  // namespace

bool can_gather(const Problem& problem) {
  if (parts::capacity(problem) > PIECE || problem.options.word("depth") == "none") return false;
  const Grid grid = grid_of(problem);
  const CellGrid across{.px = grid.cell_px()};
  return list_bytes(problem, grid) <= std::min(MOST_LIST_BYTES, problem.traits.max_storage_buffer_bytes) &&
         across.across(problem.width) <= problem.traits.max_groups[0] &&
         across.across(problem.height) <= problem.traits.max_groups[1];
}

Plan plan_at_once(const Problem& problem) {
  const Grid grid = grid_of(problem);
  const bool bits = problem.options.word("container") == "bits";
  Plan plan;
  plan.cells = grid.tiles;
  const ResourceId cells = plan.add({.name = "cells", .bytes = grid.most_cells() * sizeof(shared::LightCell)});
  const ResourceId rows = plan.add({.name = bits ? "tile bits" : "tile spans", .bytes = grid.rows() * row_bytes(bits)});
  const ResourceId lists = plan.add({.name = bits ? "cell lists" : "tile lists",
                                     .bytes = bits ? grid.most_cells() * PIECE * 4 : list_bytes(problem, grid)});
  const std::vector<Binding> bindings{{INPUT_FRAME},          {INPUT_LIGHTS},
                                      {INPUT_SPHERES},        {INPUT_DEPTH},
                                      {cells, Access::write}, {rows, Access::write},
                                      {lists, Access::write}, parts::radial_binding(problem, INPUT_SPHERES)};
  plan.passes = {pass_of(problem, grid, bindings)};
  if (grid.has_finer) {
    const Grid finer = of_tiles(problem, grid);
    plan.finer = {{.shift = log2_of(grid.cell_tiles),
                   .cells = {.px = finer.cell_px()},
                   .most_cells = FEW_TILES,
                   .passes = {pass_of(problem, finer, bindings)}}};
  }
  plan.lookup = {.name = bits ? "cell_bits" : "cell_lists",
                 .constants = with_slices({grid.tile_px, log2_of(grid.cell_tiles)}, problem, 1, 1),
                 .bindings = {{INPUT_FRAME}, {cells}, {rows}, {lists}}};
  // A cell has one piece, at its own place.
  plan.lookup.constants.insert(plan.lookup.constants.end(), {1U, grid.has_finer ? 1U : 0U});
  if (!bits) plan.lookup.bindings.push_back({lists});
  return plan;
}

}  // namespace lamp::lamplight
