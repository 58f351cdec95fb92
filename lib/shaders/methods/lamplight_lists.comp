// A piece of a cell's lights by one work group: put in order, tested exactly against every tile that the light's rectangle
// covers, and written as one ascending list a tile.
// A bit matrix in shared memory (tiles x lights) holds who reaches what, so that each list is written once and in order.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint TILE_PX = 16;
layout(constant_id = 2) const uint CELL_TILES = 4;
layout(constant_id = 3) const uint BLOCK = 256;      // lights
layout(constant_id = 4) const uint CELLS = 1;
layout(constant_id = 5) const uint PIECE = 256;      // entries, a multiple of 32
layout(constant_id = 6) const uint LIST_ENTRIES = 1;
layout(constant_id = 7) const uint WINDOW = 320;     // PIECE + 64
layout(constant_id = 8) const uint RUN_WORDS = 8;    // bits of a block
layout(constant_id = 9) const uint MAY_WRAP = 0;     // 1: all lists together might have 2^32 entries
layout(constant_id = 10) const uint PAIRS = 1024;    // of light and tile that wait in shared memory
#define BOUNDS BOUNDS_MASK
#define TEST TEST_EXACT
#define SPOT SPOT_CONE_SEGMENTS
#include "common/sphere_tests.glsl"
#include "common/spot_tests.glsl"
#include "lamplight/shared/counters.h"
#include "lamplight/shared/lamplight.h"

layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) readonly buffer LightBuffer { Light lights[]; };
layout(set = 0, binding = 2, scalar) readonly buffer TileBuffer { TileDepths tile_depths[]; };
layout(set = 0, binding = 3, scalar) readonly buffer SphereBuffer { LightBounds spheres[]; };
layout(set = 0, binding = 4, scalar) readonly buffer CellBuffer { LightCell cells[]; };
layout(set = 0, binding = 5, scalar) readonly buffer PieceBuffer { uint piece_cells[]; };
layout(set = 0, binding = 6, scalar) readonly buffer EntryBuffer { uint entries[]; };
layout(set = 0, binding = 7, scalar) readonly buffer PlaceBuffer { uint places[]; };  // [block][cell]
layout(set = 0, binding = 8, scalar) buffer TotalBuffer { LightTotals totals; };
layout(set = 0, binding = 9, scalar) buffer CounterBuffer { Counters counters; };
layout(set = 0, binding = 10, scalar) writeonly buffer SpanBuffer { LightSpan spans[]; };
layout(set = 0, binding = 11, scalar) writeonly buffer ListBuffer { uint lists[]; };
layout(set = 0, binding = 12, scalar) writeonly buffer PieceListBuffer { uint piece_lists[]; };

#include "methods/lamplight_order.glsl"
#include "methods/lamplight_marks.glsl"

shared uint s_list_size[ROWS];
shared uint s_list_begin[ROWS];
shared uint s_base;

uint lights_before(uint row, uint word) {
  uint count = 0u;
  for (uint i = 0u; i < word; ++i) count += uint(bitCount(s_bits[bit_word(row, i)]));
  return count;
}

// Room for all rows' lists together. By one thread; where the total could begin anew, after a look at it.
void reserve_lists(uint size) {
  const bool full = MAY_WRAP != 0u && totals.list_entries > LIST_ENTRIES;
  const uint begin = full ? LIST_ENTRIES : atomicAdd(totals.list_entries, size);
  s_base = size == 0u || (begin <= LIST_ENTRIES && size <= LIST_ENTRIES - begin) ? begin : ~0u;
}

void write_list_word(uint row, uint word) {
  uint place = s_base + s_list_begin[row] + lights_before(row, word);
  for (uint bits = s_bits[bit_word(row, word)]; bits != 0u; bits &= bits - 1u)
    lists[place++] = s_lights[word * 32u + uint(findLSB(bits))];
}

// Returns whether the lists fit.
bool cull_rows(uvec2 cell_tile, uint first_row, uint begin, uint count) {
  const uint thread = gl_LocalInvocationIndex;
  const uint threads = gl_WorkGroupSize.x;
  const uint rows = min(TILES, ROWS);
  const uint words = (count + 31u) / 32u;
  mark_lights(cell_tile, first_row, count);
  barrier();  // all bits before they are counted
  for (uint row = thread; row < rows; row += threads) s_list_size[row] = lights_before(row, words);
  barrier();  // sizes before they are added up
  for (uint row = thread; row < rows; row += threads) {
    uint before = 0u;
    for (uint i = 0u; i < row; ++i) before += s_list_size[i];
    s_list_begin[row] = before;
    if (row == rows - 1u) reserve_lists(before + s_list_size[row]);
  }
  barrier();  // places before lists are written
  const bool fits = s_base != ~0u;
  for (uint i = thread; fits && i < rows * words; i += threads) write_list_word(i % rows, i / rows);
  for (uint row = thread; row < rows; row += threads)
    spans[gl_WorkGroupID.x * TILES + first_row + row] =
        fits ? LightSpan(s_base + s_list_begin[row], s_list_size[row]) : LightSpan(begin | COARSE, count);
  return fits;
}

void main() {
  const uint piece = gl_WorkGroupID.x;
  const uint cell_index = piece_cells[piece];
  if (cell_index == NO_CELL) return;
  const LightCell cell = cells[cell_index];
  const uint begin = piece * PIECE;
  const uint cell_begin = cell.first_piece * PIECE;
  const uint cell_end = cell_begin + cell.entries;
  const uint end = min(begin + PIECE, cell_end);
  const uint cells_wide = (frame.size_px.x + TILE_PX * CELL_TILES - 1u) / (TILE_PX * CELL_TILES);
  const uvec2 cell_tile = uvec2(cell_index % cells_wide, cell_index / cells_wide) * CELL_TILES;
  prepare_rows(cell_tile, 0u, end - begin);
  order_lights(cell_index, cell_begin, cell_end, begin, end);
  bool all_fit = true;
  for (uint first_row = 0u; first_row < TILES; first_row += ROWS) {
    if (first_row > 0u) {
      barrier();  // rows and places are read before they are replaced
      prepare_rows(cell_tile, first_row, end - begin);
      barrier();  // rows and cleared bits before lights are tested
    }
    const bool fits = cull_rows(cell_tile, first_row, begin, end - begin);
    all_fit = all_fit && fits;
  }
  if (all_fit) return;
  // The piece's lights stand in for the lists that did not fit.
  for (uint i = gl_LocalInvocationIndex; i < end - begin; i += gl_WorkGroupSize.x) piece_lists[begin + i] = s_lights[i];
  if (gl_LocalInvocationIndex == 0u) atomicAdd(counters.overflowed_cells, TILES);
}
