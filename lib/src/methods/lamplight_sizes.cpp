// Implements lamplight_sizes.h.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight_sizes.h"

#include <algorithm>
#include <bit>
#include <string_view>

namespace lamp::lamplight {
namespace {

using shared::PIECE;
// Tuned on an H100 and an H200, blocks and posts, 64k and 1M lights; docs/methods/lamplight.md says what else was
// tried.
constexpr std::uint32_t GROUP_SUBGROUPS = 8;     // more of them than of their lights cost a software device its time
constexpr std::uint32_t FEW_HELD = 2;            // squares, of one sample a pixel
constexpr std::uint32_t MOST_HELD = 8;           // of several, as the shader has room for
constexpr std::uint32_t CELL_SLICES = 4;         // without depth buffer
constexpr std::uint32_t WANTED_BLOCKS = 256;     // rows of the matrix
constexpr std::uint32_t LARGEST_BLOCK = 8192;    // lights
constexpr std::uint32_t SMALLEST_BLOCK = 32;     // lights
constexpr std::uint64_t CELL_PIECES = 2;         // for each cell, besides those of mean_cells
constexpr std::uint64_t FEW_PIECES = 1024;       // as many instead, unless all lights in all cells take fewer
constexpr std::uint64_t FEW_BITS_PIECES = 4096;  // likewise, of cells with bits: pieces take less memory there
constexpr std::uint64_t CELL_BITS_BYTES = 5U << 20;          // of all cells, at most, for cells=auto
constexpr std::uint64_t SPARSE_CELL_BITS_BYTES = 17U << 20;  // likewise, with depth buffer and at most SPARSE_LIGHTS
constexpr std::uint64_t MEAN_CAPACITY = 32;                  // default of the option
constexpr std::uint64_t LIST_LIGHTS = 4;          // entries for each light that are room as well, within LIST_BUDGET
constexpr std::uint64_t LIST_BUDGET = 5U << 18;   // entries, 5 MiB: what pictures leave of it is room as well
constexpr std::uint64_t MOST_ENTRIES = 1U << 30;  // an entry's place has 31 bits
// A hit's place holds any cell, and beside it any rank in a block.
constexpr std::uint32_t LEAST_CELL_PX = LEAST_TILE_PX * MOST_CELL_TILES;  // in the largest picture
constexpr std::uint32_t MOST_CELLS_ACROSS = (MAX_IMAGE_SIZE + LEAST_CELL_PX - 1) / LEAST_CELL_PX;
constexpr std::uint32_t MOST_LAYERS = (MOST_SLICES + CELL_SLICES - 1) / CELL_SLICES;
static_assert(MOST_CELLS_ACROSS * MOST_CELLS_ACROSS * MOST_LAYERS <= 1U << shared::HIT_CELL_BITS);
static_assert(LARGEST_BLOCK <= 1U << (32 - shared::HIT_CELL_BITS));

std::uint32_t block_size(std::uint32_t lights) {
  const std::uint32_t wanted = parts::divide_up(parts::divide_up(lights, WANTED_BLOCKS), SMALLEST_BLOCK);
  return std::clamp(wanted * SMALLEST_BLOCK, SMALLEST_BLOCK, LARGEST_BLOCK);
}

/// As every limit of the device allows: one work group each in the last pass and a span a tile; PIECE hits, with a
/// thread each where they are scattered.
std::uint64_t most_pieces(const Problem& problem, const Sizes& s) {
  const std::uint64_t bytes = problem.traits.max_storage_buffer_bytes;
  const std::uint64_t groups = problem.traits.max_groups[0];
  return std::min({MOST_ENTRIES / PIECE, groups, groups * find_threads(problem) / PIECE,
                   bytes / s.row_bytes() / s.cell_rows, bytes / sizeof(shared::LightHit) / PIECE});
}

/// Entries of all lists together, if every light is in each of them.
std::uint64_t worst_lists(const Problem& problem, const Sizes& s) {
  return s.tiles * s.slices * parts::capacity(problem);
}

/// With mean_cells=0 two a cell and no more.
std::uint64_t wanted_pieces(const Problem& problem, const Sizes& s) {
  const std::uint64_t lights = parts::capacity(problem);
  const std::uint64_t room = lights * problem.options.integer("mean_cells");
  const std::uint64_t all = s.cell_count * ((lights + PIECE - 1) / PIECE);
  const std::uint64_t few = s.cell_bits ? FEW_BITS_PIECES : FEW_PIECES;
  const bool is_small = all <= few || worst_lists(problem, s) <= parts::SMALL_LISTS;
  const std::uint64_t least = room == 0 ? 0 : is_small ? all : few;
  return (room + PIECE - 1) / PIECE + std::max(CELL_PIECES * s.cell_count, least);
}

/// Lights in lists that there is room for.
std::uint64_t wanted_entries(const Problem& problem, const Sizes& s) {
  const std::uint64_t mean = problem.options.integer("mean_capacity");
  const std::uint64_t worst = worst_lists(problem, s);
  if (mean >= MEAN_CAPACITY && worst <= parts::SMALL_LISTS) return worst;
  const std::uint64_t rows = s.tiles * s.slices;
  const std::uint64_t left = LIST_BUDGET - std::min(LIST_BUDGET, MEAN_CAPACITY * rows);
  const std::uint64_t lights = parts::capacity(problem);
  return std::min(rows * mean + std::min(LIST_LIGHTS * lights, left), worst);
}

/// Tiles, slices, and cells of them.
Sizes grid_of(const Problem& problem) {
  const Options& o = problem.options;
  Sizes s{.tile_px = o.integer("tile"), .slices = 1, .cell_slices = 1};
  if (o.word("depth") == "none") {
    s.slices = o.integer("slices");
    s.cell_slices = CELL_SLICES;
  }
  s.tiles = parts::tile_count(problem, s.tile_px);
  s.cell_tiles = cell_tiles(problem.width, problem.height, s.tile_px, parts::capacity(problem));
  s.cells = parts::tile_count(problem, s.cell_px());
  // Smaller pictures may have more cells, of fewer tiles.
  for (std::uint32_t tiles = LEAST_CELL_TILES; problem.smaller_frames && tiles < s.cell_tiles; tiles *= 2)
    s.cells = std::max<std::uint64_t>(s.cells, most_cells(tiles, parts::capacity(problem)));
  s.cell_count = static_cast<std::uint32_t>(s.cells) * s.cell_grid().layers;
  s = with_cell_tiles(s, s.cell_tiles);
  s.bits = o.word("container") == "bits";
  return s;
}

bool wants_cell_bits(const Problem& problem, const Sizes& s) {
  const std::string_view wanted = problem.options.word("cells");
  const std::uint64_t words = parts::divide_up(parts::capacity(problem), WORD_LIGHTS);
  const bool is_sparse = parts::capacity(problem) <= SPARSE_LIGHTS;
  const std::uint64_t most = s.sliced() || !is_sparse ? CELL_BITS_BYTES : SPARSE_CELL_BITS_BYTES;
  return wanted == "bits" || (wanted == "auto" && words * 4 * s.cell_count <= most);
}

}  // namespace

std::uint32_t group_threads(const Problem& problem, std::uint32_t wanted) {
  return std::min(wanted, std::bit_floor(problem.traits.max_group_invocations));
}

std::uint32_t full_threads(const Problem& problem, std::uint32_t wanted) {
  return group_threads(problem, std::max(wanted, problem.traits.max_subgroup_size));
}

std::uint32_t light_threads(const Problem& problem) {
  return full_threads(problem, std::clamp(GROUP_SUBGROUPS * problem.traits.subgroup_size, GROUP_ROWS, THREADS));
}

std::uint32_t find_threads(const Problem& problem) {
  const auto fits = [&](std::uint32_t threads) {
    return parts::divide_up(parts::capacity(problem), threads) <= problem.traits.max_groups[0];
  };
  if (const std::uint32_t threads = light_threads(problem); fits(threads)) return threads;
  return full_threads(problem, fits(THREADS) ? THREADS : 2 * THREADS);
}

bool has_small_subgroups(const Problem& problem) { return problem.traits.subgroup_size < 32; }

std::uint32_t squares_held(const Problem& problem) {
  if (has_small_subgroups(problem)) return 1;
  const std::uint32_t tile_px = problem.options.integer("tile");
  const std::uint32_t squares = tile_px * tile_px * problem.depth_samples / 4;
  return std::clamp(squares / problem.traits.subgroup_size, 1U, problem.depth_samples == 1 ? FEW_HELD : MOST_HELD);
}

std::vector<std::uint32_t> with_slices(std::vector<std::uint32_t> constants, const Problem& problem,
                                       std::uint32_t cell_slices, std::uint32_t slices) {
  const Options& o = problem.options;
  constants.insert(constants.end(), {cell_slices, slices, parts::slice_scale(o.word("scale")), o.integer("near_mm"),
                                     o.integer("far_m")});
  return constants;
}

std::uint32_t log2_of(std::uint32_t power) { return static_cast<std::uint32_t>(std::countr_zero(power)); }

Sizes with_cell_tiles(Sizes s, std::uint32_t cell_tiles) {
  s.cell_tiles = cell_tiles;
  s.cell_rows = cell_tiles * cell_tiles * s.cell_slices;
  // Of one slice, in whole lines of tiles.
  s.group_rows = std::max(std::min(GROUP_ROWS, cell_tiles * cell_tiles), cell_tiles);
  return s;
}

CellGrid finest_cells(const Problem& problem, const Sizes& sizes) {
  const std::uint32_t tiles = problem.smaller_frames ? std::min(LEAST_CELL_TILES, sizes.cell_tiles) : sizes.cell_tiles;
  return with_cell_tiles(sizes, tiles).cell_grid();
}

Sizes sizes_of(const Problem& problem) {
  Sizes s = grid_of(problem);
  s.cell_bits = wants_cell_bits(problem, s);
  s.block = s.cell_bits ? WORD_LIGHTS : block_size(parts::capacity(problem));
  s.blocks = parts::divide_up(parts::capacity(problem), s.block);
  s.pieces = static_cast<std::uint32_t>(std::min(wanted_pieces(problem, s), most_pieces(problem, s)));
  if (s.cell_bits) s.pieces = std::max(s.pieces, s.cell_count);  // each has its own
  s.entries = s.pieces * PIECE;
  if (s.bits) return s;
  s.listed = static_cast<std::uint32_t>(
      std::min({wanted_entries(problem, s), MOST_ENTRIES, problem.traits.max_storage_buffer_bytes / 4}));
  return s;
}

}  // namespace lamp::lamplight
