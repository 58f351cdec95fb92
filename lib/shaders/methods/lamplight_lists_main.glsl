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

layout(set = 0, binding = 3, scalar) readonly buffer PieceBuffer { LightPiece cell_pieces[]; };
layout(set = 0, binding = 4, scalar) buffer TotalBuffer { LightTotals totals; };
layout(set = 0, binding = 5, scalar) writeonly buffer RowBuffer { uint rows[]; };  // LightSpan, or PIECE_WORDS words
layout(set = 0, binding = 6, scalar) writeonly buffer PieceListBuffer { uint piece_lists[]; };
layout(set = 0, binding = 7, scalar) writeonly buffer ListBuffer { uint lists[]; };  // not of bits
#ifdef CELL_BITS
layout(set = 0, binding = 8, scalar) readonly buffer BitBuffer { uint cell_bits[]; };  // [cell][word]
#define DEPTH_BINDING 9
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

shared uint s_list_size[ROWS];
shared uint s_list_begin[ROWS];
shared uint s_base;

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

// Room for all rows' lists together. By one thread; where the total could begin anew, after a look at it.
void reserve_lists(uint size) {
  const bool full = MAY_WRAP != 0u && totals.list_entries > LIST_ENTRIES;
  const uint begin = full ? LIST_ENTRIES : atomicAdd(totals.list_entries, size);
  s_base = size == 0u || (begin <= LIST_ENTRIES && size <= LIST_ENTRIES - begin) ? begin : ~0u;
}

// By all threads of the group together. Returns whether the lists fit; if not, the piece's lights stand for each of
// them.
bool write_lists(Cell cell, uint begin, uint count) {
  const uint thread = gl_LocalInvocationIndex;
  const uint threads = gl_WorkGroupSize.x;
  const uint words = (count + 31u) / 32u;
  for (uint row = thread; row < ROWS; row += threads) s_list_size[row] = lights_before(row, words);
  barrier();  // sizes before they are added up
  for (uint row = thread; row < ROWS; row += threads) {
    uint before = 0u;
    for (uint i = 0u; i < row; ++i) before += s_list_size[i];
    s_list_begin[row] = before;
    if (row == ROWS - 1u) reserve_lists(before + s_list_size[row]);
  }
  barrier();  // places before lists are written
  const bool fits = s_base != ~0u;
  for (uint i = thread; fits && i < ROWS * words; i += threads)
    write_list_word(i % ROWS, i / ROWS, s_base + s_list_begin[i % ROWS]);
  for (uint row = thread; row < ROWS; row += threads) {
    const uint at = 2u * (gl_WorkGroupID.x * CELL_ROWS + cell.first_row + row);
    rows[at] = fits ? s_base + s_list_begin[row] : begin | COARSE;
    rows[at + 1u] = fits ? s_list_size[row] : count;
  }
  if (!fits && thread == 0u) atomicAdd(totals.counters.overflowed_cells, ROWS);
  return fits;
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

void main() {
  const uint piece = gl_WorkGroupID.x;
  const LightPiece listed = cell_pieces[piece];
  if (listed.cell == NO_CELL) return;
  const Cell cell = cell_of(listed.cell);
  const uint begin = piece * PIECE;
  const uint end = min(begin + PIECE, listed.end);
  clear_marks();
  for (uint row = gl_LocalInvocationIndex; row < ROWS; row += gl_WorkGroupSize.x) load_row(cell, row);
  order_lights(listed, begin, end);
  mark_lights(cell, end - begin);
  barrier();  // all bits before they are read
  bool needs_piece = BITS && gl_WorkGroupID.y == 0u;
  if (BITS)
    write_bits(gl_WorkGroupID.x * CELL_ROWS + cell.first_row);
  else
    needs_piece = !write_lists(cell, begin, end - begin);
  if (!needs_piece) return;
  for (uint i = gl_LocalInvocationIndex; i < end - begin; i += gl_WorkGroupSize.x) piece_lists[begin + i] = s_lights[i];
}
