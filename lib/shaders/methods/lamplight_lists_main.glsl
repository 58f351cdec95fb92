// A piece of a cell's lights by one work group for each ROWS rows of the cell: put in order, tested exactly against
// every row that the light's rectangle covers, and written as one ascending list a row, or as one bit a row and light.
// A bit matrix in shared memory (rows x lights) holds who reaches what, so that each list is written once and in order.
// SPDX-License-Identifier: Apache-2.0
layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint TILE_PX = 16;
layout(constant_id = 2) const uint CELL_TILES = 4;
layout(constant_id = 3) const uint LIST_ENTRIES = 1;
layout(constant_id = 4) const uint MAY_WRAP = 0;     // 1: all lists together might have 2^32 entries
layout(constant_id = 5) const uint PAIRS = 1024;     // of light and row that wait in shared memory
layout(constant_id = 6) const uint ROWS = 16;        // that a work group looks at: whole lines of tiles, of one slice
layout(constant_id = 7) const uint MARK_WORDS = 64;  // PIECE_WORDS for each of them
layout(constant_id = 8) const uint CELL_ROWS = 16;
layout(constant_id = 9) const bool BITS = false;     // the container: bits, or lists
#ifdef SLICED
layout(constant_id = 13) const uint CELL_SLICES = 4;
#define SLICE_CONSTANT 14
#include "common/slice_constants.glsl"
#endif
#include "methods/lamplight_exact.glsl"

#ifdef CELL_BITS
layout(set = 0, binding = 3, scalar) buffer CellBuffer { LightCell cells[]; };
#else
layout(set = 0, binding = 3, scalar) readonly buffer PieceBuffer { LightPiece cell_pieces[]; };
#endif
layout(set = 0, binding = 4, scalar) buffer TotalBuffer { LightTotals totals; };
layout(set = 0, binding = 5, scalar) writeonly buffer RowBuffer { uint rows[]; };  // LightSpan, or PIECE_WORDS words
layout(set = 0, binding = 6, scalar) writeonly buffer PieceListBuffer { uint piece_lists[]; };
layout(set = 0, binding = 7, scalar) writeonly buffer ListBuffer { uint lists[]; };  // not of bits
#ifdef CELL_BITS
layout(set = 0, binding = 8, scalar) readonly buffer BitBuffer { uint cell_bits[]; };  // [cell][word]
#define DEPTH_BINDING 9
#include "methods/lamplight_bit_pieces.glsl"
#include "methods/lamplight_bit_order.glsl"
#else
layout(set = 0, binding = 8, scalar) readonly buffer EntryBuffer { uint entries[]; };
layout(set = 0, binding = 9, scalar) readonly buffer PlaceBuffer { uint places[]; };  // [block][cell]
#define DEPTH_BINDING 10
#include "methods/lamplight_list_order.glsl"
#endif
#ifndef SLICED
layout(set = 0, binding = DEPTH_BINDING, scalar) readonly buffer TileBuffer { TileDepths tile_depths[]; };
#endif
#ifdef PRUNED
layout(set = 0, binding = DEPTH_BINDING + 1) uniform texture2D depth_image;
#endif

#include "methods/lamplight_marks.glsl"
#include "methods/lamplight_row_lists.glsl"
#include "methods/lamplight_list_room.glsl"

TileDepths depths_of_row(Cell cell, uvec2 tile) {
#ifdef SLICED
  const uint slice = cell.first_slice + cell.first_row / TILES;
  const float begin = is_perspective(frame) ? max(slice_begin(slice), 0.0) : slice_begin(slice);
  return slice < SLICES ? TileDepths(begin, slice_end(slice), 0.0, ~0u) : TileDepths(EMPTY_NEAR, EMPTY_FAR, 0.0, 0u);
#else
  const uint tiles_wide = (frame.size_px.x + TILE_PX - 1u) / TILE_PX;
  return tile_depths[tile.x + tiles_wide * tile.y];
#endif
}

// By one thread a row.
void load_row(Cell cell, uint row) {
  const uvec2 tile = tile_of_row(cell, row);
  s_depths[row] = is_in_picture(tile) ? depths_of_row(cell, tile) : TileDepths(EMPTY_NEAR, EMPTY_FAR, 0.0, 0u);
  load_sides(cell, row);
}

Cell cell_of(uint index) {
  const uvec2 size = (frame.size_px + TILE_PX * CELL_TILES - 1u) / (TILE_PX * CELL_TILES);
  const uint in_layer = index % (size.x * size.y);
#ifdef SLICED
  const uint first_slice = index / (size.x * size.y) * CELL_SLICES;
#else
  const uint first_slice = 0u;
#endif
  return Cell(uvec2(in_layer % size.x, in_layer / size.x) * CELL_TILES, gl_WorkGroupID.y * ROWS, first_slice);
}

// By all threads of the group together: entries [begin, end) of the listed, which are kept as the piece at `place`.
void cull_piece(LightPiece listed, uint begin, uint place) {
  const Cell cell = cell_of(listed.cell);
  const uint end = min(begin + PIECE, listed.end);
  const uint count = end - begin;
  clear_marks();
  if (gl_LocalInvocationIndex < ROWS) load_row(cell, gl_LocalInvocationIndex);
  order_lights(listed, begin, end);
  mark_lights(cell, count);
  barrier();  // all bits before they are read
  bool needs_piece = BITS && gl_WorkGroupID.y == 0u;
  if (BITS)
    write_bits(place * CELL_ROWS + cell.first_row);
  else
    needs_piece = !write_lists(cell, place, count);
  if (!needs_piece) return;
  for (uint i = gl_LocalInvocationIndex; i < count; i += gl_WorkGroupSize.x)
    piece_lists[place * PIECE + i] = s_lights[i];
}

#ifdef CELL_BITS
void main() {
  const bool is_first = gl_WorkGroupID.x < CELLS;
  uint number = gl_WorkGroupID.x - CELLS;
  CellPiece piece = CellPiece(gl_WorkGroupID.x, 0u, gl_WorkGroupID.x);
  if (!is_first) piece = further_piece(number, number == 0u && gl_WorkGroupID.y == 0u);
  while (piece.cell != NO_CELL) {
    const LightPiece listed = LightPiece(piece.cell, 0u, cells[piece.cell].entries);
    if (listed.end == 0u) return;
    cull_piece(listed, piece.number * PIECE, piece.place);
    if (is_first) {
      const bool is_only = listed.end <= PIECE && gl_WorkGroupID.y == 0u;
      if (is_only && gl_LocalInvocationIndex == 0u) cells[piece.cell].pieces = 1u;
      return;
    }
    barrier();  // shared memory is read before the next piece takes it
    number += gl_NumWorkGroups.x - CELLS;
    piece = further_piece(number, false);
  }
}
#else
void main() {
  const uint piece = gl_WorkGroupID.x;
  if (cell_pieces[piece].cell != NO_CELL) cull_piece(cell_pieces[piece], piece * PIECE, piece);
}
#endif
