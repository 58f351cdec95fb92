// The cell of a pixel and its row in it: the tile, and without a depth buffer the tile in a slice of depth.
// SPDX-License-Identifier: Apache-2.0
#include "lookup/parts/resources.glsl"
#include "lamplight/shared/lamplight.h"

LOOKUP_CONSTANT(0, uint, LOOKUP_TILE_PX, 16);
LOOKUP_CONSTANT(1, uint, LOOKUP_CELL_LOG2, 2);  // of the tiles along a side of a cell, in the largest picture
LOOKUP_CONSTANT(2, uint, LOOKUP_CELL_SLICES, 1);
// 1: a cell's first piece is kept at the cell's own place, so that it can be read before the cell is, and first_piece
// is the next one.
LOOKUP_CONSTANT(7, uint, LOOKUP_FIRST_AT_CELL, 0);
LOOKUP_CONSTANT(8, uint, LOOKUP_FINER, 0);  // 1: cells of smaller pictures may have fewer tiles
LOOKUP_BUFFER(1, LookupCells, LightCell, lookup_cells);
LOOKUP_VIEW_WORDS(1, LOOKUP_CELLS_VIEW);
LAMP_CONST LOOKUP_CELL_WORDS = 3u;  // of a LightCell

#define LOOKUP_SLICE_CONSTANT 3
#include "lookup/parts/slice_constants.glsl"

// log2 of the tiles along a side of a cell of the view's picture; its rows.
uint lookup_cell_log2(uint view) {
  return LOOKUP_FINER == 0u ? LOOKUP_CELL_LOG2 : LOOKUP_CELL_LOG2 - lookup_frames[view].cell_shift;
}
uint lookup_cell_rows(uint view) { return LOOKUP_CELL_SLICES << 2u * lookup_cell_log2(view); }

void lookup_prepare() {}

uint lookup_slice(float z_view) { return LOOKUP_SLICES == 1u ? 0u : slice_of(z_view); }

uint lookup_cell(uint view, uvec2 pixel, float z_view) {
  const uvec2 tile = pixel / LOOKUP_TILE_PX;
  const uvec2 tiles = squares_across(lookup_frames[view], LOOKUP_TILE_PX);
  return tile.x + tiles.x * (tile.y + tiles.y * lookup_slice(z_view));
}

// Of the view's own cells.
uint lookup_light_cell(uint view, uvec2 pixel, float z_view) {
  const uint log2_tiles = lookup_cell_log2(view);
  const uvec2 at = pixel / LOOKUP_TILE_PX >> log2_tiles;
  const uvec2 tiles = squares_across(lookup_frames[view], LOOKUP_TILE_PX);
  const uvec2 across = tiles + ((1u << log2_tiles) - 1u) >> log2_tiles;
  return at.x + across.x * (at.y + across.y * (lookup_slice(z_view) / LOOKUP_CELL_SLICES));
}

// Among the rows of the cell.
uint lookup_row(uint view, uvec2 pixel, float z_view) {
  const uint log2_tiles = lookup_cell_log2(view);
  const uvec2 tile = pixel / LOOKUP_TILE_PX & (1u << log2_tiles) - 1u;
  return tile.x + (tile.y << log2_tiles) + (lookup_slice(z_view) % LOOKUP_CELL_SLICES << 2u * log2_tiles);
}

LightCell lookup_cell_at(uint view, uint index) {
  return lookup_cells[view * (LOOKUP_CELLS_VIEW / LOOKUP_CELL_WORDS) + index];
}
