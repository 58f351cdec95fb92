// A piece of a cell's lights by one work group for each ROWS rows of the cell, or for a part of these: put in order,
// tested exactly against every row, and written as one ascending list a row, or as one bit a row and light.
// A bit matrix in shared memory (rows x lights) holds who reaches what, so that each list is written once and in order.
// SPDX-License-Identifier: Apache-2.0
layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint TILE_PX = 16;
layout(constant_id = 2) const uint CELL_TILES = 4;
layout(constant_id = 3) const uint LIST_ENTRIES = 1;
layout(constant_id = 4) const uint PAIRS = 1024;     // of light and row that wait in shared memory
layout(constant_id = 5) const uint ROWS = 16;        // that a work group looks at: whole lines of tiles, of one slice
layout(constant_id = 6) const uint MARK_WORDS = 64;  // PIECE_WORDS for each of them
layout(constant_id = 7) const uint CELL_ROWS = 16;
layout(constant_id = 8) const bool BITS = false;     // the container: bits, or lists
layout(constant_id = 9) const uint FURTHER = 0;      // FURTHER_*
#ifdef SLICED
layout(constant_id = 15) const uint CELL_SLICES = 4;
#define SLICE_CONSTANT 16
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

#include "methods/lamplight_cell_piece.glsl"

#ifdef CELL_BITS
const bool LIGHTS_MISS = false;  // the code for it costs more here than it saves
layout(set = 0, binding = 8, scalar) readonly buffer BitBuffer { uint cell_bits[]; };  // [cell][word]
#define DEPTH_BINDING 10
#include "methods/lamplight_bit_pieces.glsl"
#include "methods/lamplight_bit_order.glsl"
#else
const bool LIGHTS_MISS = CELL_ROWS > ROWS;
layout(set = 0, binding = 8, scalar) readonly buffer EntryBuffer { uint entries[]; };
layout(set = 0, binding = 9, scalar) readonly buffer PlaceBuffer { uint places[]; };  // [block][cell]
#define DEPTH_BINDING 11
#include "methods/lamplight_list_order.glsl"
#endif
#define RADIAL_BINDING (DEPTH_BINDING - 1)
#ifndef SLICED
layout(set = 0, binding = DEPTH_BINDING, scalar) readonly buffer TileBuffer { TileDepths tile_depths[]; };
#endif
#ifdef PRUNED
layout(set = 0, binding = DEPTH_BINDING + 1) uniform DepthImage depth_image;
#endif

#include "methods/lamplight_marks.glsl"
#include "methods/lamplight_row_lists.glsl"
#include "methods/lamplight_list_room.glsl"

TileDepths depths_of_row(Cell cell, uvec2 tile) {
#ifdef SLICED
  const uint slice = cell.first_slice + cell.first_row / TILES;
  const float begin = from_eye(frame, slice_begin(slice));
  return slice < SLICES ? TileDepths(begin, slice_end(slice), 0.0, ~0u) : TileDepths(EMPTY_NEAR, EMPTY_FAR, 0.0, 0u);
#else
  const uint tiles_wide = squares_across(frame, TILE_PX).x;
  return tile_depths[tile.x + tiles_wide * tile.y];
#endif
}

// By one thread a row.
void load_row(Cell cell, uint row) {
  const uvec2 tile = tile_of_row(cell, row);
  s_depths[row] = is_in_picture(tile) ? depths_of_row(cell, tile) : TileDepths(EMPTY_NEAR, EMPTY_FAR, 0.0, 0u);
}

Cell cell_of(CellPiece piece) {
  const uvec2 size = squares_across(frame, TILE_PX * CELL_TILES);
#ifdef SLICED
  const uint in_layer = piece.cell % (size.x * size.y);
  const uint first_slice = piece.cell / (size.x * size.y) * CELL_SLICES;
#else
  const uint in_layer = piece.cell;
  const uint first_slice = 0u;
#endif
  return Cell(uvec2(in_layer % size.x, in_layer / size.x) * CELL_TILES, gl_WorkGroupID.y * ROWS + piece.row,
              piece.rows, first_slice);
}

// By all threads of the group together: from marks to what the look-up reads.
void write_piece(CellPiece piece) {
  const uint first_row = piece.place * CELL_ROWS + gl_WorkGroupID.y * ROWS + piece.row;
  bool needs_lights = BITS && gl_WorkGroupID.y == 0u && piece.row == 0u;
  if (BITS)
    write_bits(first_row, piece.rows);
  else
    needs_lights = !write_lists(piece, first_row);
  if (!needs_lights) return;
  for (uint first = 0u; first < PIECE; first += gl_WorkGroupSize.x) {
    const uint i = first + gl_LocalInvocationIndex;
    if (i < piece.count) piece_lists[piece.place * PIECE + i] = s_lights[i];
  }
}

// By all threads of the group together.
void cull_piece(CellPiece piece) {
  const OrderLoad load = load_order(piece);
  const Cell cell = cell_of(piece);
  clear_marks();
  if (gl_LocalInvocationIndex < cell.rows) load_row(cell, gl_LocalInvocationIndex);
  if (gl_LocalInvocationIndex < CELL_TILES) load_sides(cell, gl_LocalInvocationIndex);
  if (LIGHTS_MISS && gl_LocalInvocationIndex == CELL_TILES) load_edges(cell);
  order_lights(load, piece);
  mark_lights(cell, piece.count);
  barrier();  // all marks before they are written
  write_piece(s_piece);
}

#ifdef CELL_BITS
void main() {
  const uint others = gl_NumWorkGroups.x - cell_count();
  const bool is_own = gl_WorkGroupID.x >= others;
  const uint cell = is_own ? gl_WorkGroupID.x - others : NO_CELL;
  const uint entries = is_own ? cells[cell].entries : 0u;
  if (is_own && entries == 0u) return;
  if (is_own && entries <= PIECE && gl_WorkGroupID.y == 0u && gl_LocalInvocationIndex == 0u) cells[cell].pieces = 1u;
  for (uint group = gl_WorkGroupID.x; true; group += others) {
    CellPiece piece = CellPiece(cell, 0u, min(entries, PIECE), cell, 0u, ROWS);
    if (gl_LocalInvocationIndex == 0u) s_piece = piece;
    if (!is_own || is_crowded(entries)) {
      if (share_pieces(is_own ? NO_GROUP : group, others, group == 0u && gl_WorkGroupID.y == 0u) && is_own) return;
      piece = s_piece;
    }
    if (piece.cell == NO_CELL) return;
    cull_piece(piece);
    if (is_own) return;
    barrier();  // shared memory is read before the next piece takes it
  }
}
#else
void main() {
  const uint place = gl_WorkGroupID.x;
  const LightPiece listed = cell_pieces[place];
  if (listed.cell == NO_CELL) return;
  const uint begin = place * PIECE;
  const CellPiece piece = CellPiece(listed.cell, begin, min(begin + PIECE, listed.end) - begin, place, 0u, ROWS);
  if (gl_LocalInvocationIndex == 0u) s_piece = piece;
  cull_piece(piece);
}
#endif
