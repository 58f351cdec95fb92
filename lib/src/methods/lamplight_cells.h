// How large the cells of `lamplight` are: what its plan and those who predict its cost (oracle/choice) have in common.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace lamp::lamplight {

// Tuned on an H100 and an H200, blocks and posts, 64k and 1M lights; docs/methods/lamplight.md says what else was
// tried.
constexpr std::uint32_t GROUP_ROWS = 64;       // of a cell that a work group looks at
constexpr std::uint32_t LEAST_CELL_TILES = 4;  // a side; fewer leave the last pass with groups of few lights
constexpr std::uint32_t MOST_CELL_TILES = 32;  // a side
constexpr std::uint32_t GOOD_CELLS = 2304;     // not more where cells can be larger; 4K has 2040
constexpr std::uint32_t FEW_CELLS = 576;       // likewise, for at most SPARSE_LIGHTS, but of GROUP_ROWS tiles at most
constexpr std::uint32_t SPARSE_LIGHTS = 1U << 17;

/// Cells of so many tiles along a side that a picture has at most, unless they cannot be larger. `lights`: that there
/// is room for.
[[nodiscard]] constexpr std::uint32_t most_cells(std::uint32_t tiles, std::uint32_t lights) {
  const bool may_be_fewer = lights <= SPARSE_LIGHTS && tiles * tiles < GROUP_ROWS;
  return may_be_fewer ? FEW_CELLS : GOOD_CELLS;
}

/// Tiles along a side of a cell, a power of two. `lights`: that there is room for.
[[nodiscard]] constexpr std::uint32_t cell_tiles(std::uint32_t width, std::uint32_t height, std::uint32_t tile_px,
                                                 std::uint32_t lights) {
  const auto is_good = [&](std::uint32_t tiles) {
    const std::uint32_t cell_px = tile_px * tiles;
    const std::uint64_t across = (width + cell_px - 1) / cell_px;
    const std::uint64_t down = (height + cell_px - 1) / cell_px;
    return across * down <= most_cells(tiles, lights);
  };
  std::uint32_t tiles = LEAST_CELL_TILES;
  while (!is_good(tiles) && tiles < MOST_CELL_TILES) tiles *= 2;
  return tiles;
}

}  // namespace lamp::lamplight
