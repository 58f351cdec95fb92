// The sizes of a plan of `lamplight`: tiles, cells of them, and how much room there is for what lights find.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "lamplight/shared/lamplight.h"
#include "lamplight_cells.h"
#include "parts.h"

namespace lamp::lamplight {

constexpr std::uint32_t THREADS = 256;  ///< of a work group, where the device takes as many

constexpr std::uint32_t WORD_LIGHTS = 32;  ///< bits

constexpr std::uint32_t LEAST_TILE_PX = 8;  ///< of the options
constexpr std::uint32_t MOST_SLICES = 32;

constexpr std::uint32_t THREAD_PAIRS = 4;  ///< of light and row for each thread that tests them, in shared memory

/// What a row keeps of a piece: a span of the lists, or bits.
[[nodiscard]] constexpr std::uint64_t row_bytes(bool bits) {
  return bits ? shared::PIECE_WORDS * 4 : sizeof(shared::LightSpan);
}

/// Every size of the plan.
struct Sizes {
  std::uint32_t tile_px, cell_tiles;
  std::uint32_t slices, cell_slices;  ///< of depth; 1 with a depth buffer
  std::uint64_t tiles, cells;         ///< of a slice, of a layer; of any picture, the most
  std::uint32_t cell_count;           ///< of all layers
  std::uint32_t cell_rows;            ///< tiles times slices
  std::uint32_t group_rows;           ///< of them, for a work group of the last pass
  bool bits;                          ///< the container
  bool cell_bits;                     ///< a cell has a bit for each light, not a list
  std::uint32_t block;                ///< lights: of a word of bits, or of a line of the count matrix
  std::uint32_t blocks;               ///< words of a cell, or lines
  std::uint32_t pieces;               ///< of PIECE lights in cells, capacity
  std::uint32_t entries;              ///< lights of cells, pairs, capacity
  std::uint32_t listed;               ///< lights in lists, capacity; 0 of bits

  [[nodiscard]] bool sliced() const { return slices > 1; }
  [[nodiscard]] std::uint32_t cell_px() const { return tile_px * cell_tiles; }
  [[nodiscard]] CellGrid cell_grid() const {
    return {.px = cell_px(), .layers = parts::divide_up(slices, cell_slices)};
  }
  /// What a row keeps of a piece: a span of the lists, or bits.
  [[nodiscard]] std::uint64_t row_bytes() const { return lamplight::row_bytes(bits); }
};

/// A power of two that the device takes.
[[nodiscard]] std::uint32_t group_threads(const Problem& problem, std::uint32_t wanted);

/// Likewise, and full subgroups, however large the device makes them (Pass::full_subgroups).
[[nodiscard]] std::uint32_t full_threads(const Problem& problem, std::uint32_t wanted);

/// Of a pass whose subgroups take lights of their own: not more than eight subgroups, where these are small, but a
/// thread for each row of a group.
[[nodiscard]] std::uint32_t light_threads(const Problem& problem);

/// Of the passes with a thread a light: larger where there would be more groups than the device has. With THREADS,
/// 65535 groups, all that some have, are one short of 16 million lights.
[[nodiscard]] std::uint32_t find_threads(const Problem& problem);

/// As software devices have, whose groups run few at once: more of them are only more work.
[[nodiscard]] bool has_small_subgroups(const Problem& problem);

/// What a thread that reads depths loads at once: if it can be, its share of a tile, which is then read once. Subgroups
/// of fewer than 32 read a tile twice either way, and a software device takes a third less time for that one by one.
[[nodiscard]] std::uint32_t squares_held(const Problem& problem);

/// How depth is sliced, after the other constants of a pass or look-up.
[[nodiscard]] std::vector<std::uint32_t> with_slices(std::vector<std::uint32_t> constants, const Problem& problem,
                                                     std::uint32_t cell_slices, std::uint32_t slices);

[[nodiscard]] Sizes sizes_of(const Problem& problem);

/// The same buffers with cells of fewer tiles a side, for smaller pictures.
[[nodiscard]] Sizes with_cell_tiles(Sizes sizes, std::uint32_t cell_tiles);

/// Of any picture: there are no more in one whose cells are larger.
[[nodiscard]] CellGrid finest_cells(const Problem& problem, const Sizes& sizes);

/// log2 of a power of two, as look-ups are told how many tiles a side of a cell has.
[[nodiscard]] std::uint32_t log2_of(std::uint32_t power);

}  // namespace lamp::lamplight
