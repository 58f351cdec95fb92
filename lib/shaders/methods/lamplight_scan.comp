// From counts to places: a group of columns (cells) of the count matrix, by one work group; each thread a strip of blocks.
// Cells get their entries in any order, a cell's own entries are in the order of the blocks. Also cuts cells into pieces
// of PIECE entries.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
#include "lamplight/shared/counters.h"
#include "lamplight/shared/frame.h"
#include "lamplight/shared/lamplight.h"

const uint COLUMNS = 16u;  // 64 bytes of a row
layout(local_size_x = 16, local_size_y_id = 0) in;
layout(constant_id = 0) const uint STRIPS = 16;
layout(constant_id = 1) const uint CELLS = 1;
layout(constant_id = 2) const uint BLOCK = 256;
layout(constant_id = 3) const uint PIECE = 1024;
layout(constant_id = 4) const uint ENTRIES = 1;  // capacity
layout(constant_id = 5) const uint TILES = 16;   // of a cell

layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) buffer CountBuffer { uint counts[]; };  // [block][cell]; becomes first places
layout(set = 0, binding = 2, scalar) writeonly buffer CellBuffer { LightCell cells[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer PieceBuffer { LightPiece pieces[]; };
layout(set = 0, binding = 4, scalar) buffer TotalBuffer { LightTotals totals; };
layout(set = 0, binding = 5, scalar) buffer CounterBuffer { Counters counters; };

shared uint s_strips[STRIPS][COLUMNS];
shared uint s_total[COLUMNS];
shared uint s_begin[COLUMNS];
shared uint s_first_piece[COLUMNS];
shared uint s_pieces[COLUMNS];

// Counts that a thread loads at once: their way from memory is most of the time.
const uint HELD = 8u;

void load_counts(uint cell, uint from, uint to, out uint held[HELD]) {
  [[unroll]] for (uint k = 0u; k < HELD; ++k) held[k] = from + k < to ? counts[(from + k) * CELLS + cell] : 0u;
}

// By one thread: places and pieces of the group's cells. Sums of 16 cells of up to 2^24 lights stay below 2^32.
void reserve_cells() {
  uint entries = 0u;
  for (uint c = 0u; c < COLUMNS; ++c) {
    s_begin[c] = entries;
    entries += s_total[c];
  }
  const uint units = (entries + ENTRY_UNIT - 1u) / ENTRY_UNIT;
  const uint begin = min(atomicAdd(totals.entry_units, units), ENTRIES / ENTRY_UNIT) * ENTRY_UNIT;
  uint wanted_pieces = 0u;
  for (uint c = 0u; c < COLUMNS; ++c) {
    const bool fits = s_begin[c] + s_total[c] <= ENTRIES - begin;
    s_begin[c] = fits ? begin + s_begin[c] : ENTRIES;
    s_pieces[c] = !fits ? ALL_LIGHTS : s_total[c] == 0u ? 0u : (s_total[c] - 1u) / PIECE + 1u;
    s_first_piece[c] = wanted_pieces;
    if (fits) wanted_pieces += s_pieces[c];
  }
  const uint first_piece = atomicAdd(totals.pieces, wanted_pieces);
  for (uint c = 0u; c < COLUMNS; ++c) s_first_piece[c] += first_piece;
}

// By one thread a cell.
void write_cell(uint cell, uint column) {
  const bool fits = s_pieces[column] != ALL_LIGHTS;
  const uint end = fits ? s_begin[column] + s_total[column] : ENTRIES;
  cells[cell] = LightCell(s_first_piece[column], s_pieces[column], end);
  if (!fits) atomicAdd(counters.overflowed_cells, TILES);
}

void main() {
  const uint column = gl_LocalInvocationID.x;
  const uint strip = gl_LocalInvocationID.y;
  const uint cell = gl_WorkGroupID.x * COLUMNS + column;
  const uint blocks = (frame.light_count + BLOCK - 1u) / BLOCK;
  const uint height = (blocks + STRIPS - 1u) / STRIPS;
  const uint from = cell < CELLS ? min(strip * height, blocks) : 0u;
  const uint to = cell < CELLS ? min(from + height, blocks) : 0u;
  if (gl_WorkGroupID.x == 0u && gl_LocalInvocationIndex == 0u) totals.one_y = totals.one_z = 1u;

  uint held[HELD];
  uint sum = 0u;
  for (uint block = from; block < to; block += HELD) {
    load_counts(cell, block, to, held);
    [[unroll]] for (uint k = 0u; k < HELD; ++k) sum += held[k];
  }
  s_strips[strip][column] = sum;
  barrier();  // all strips before they are added up
  uint before = 0u;
  for (uint i = 0u; i < strip; ++i) before += s_strips[i][column];
  if (strip == STRIPS - 1u) s_total[column] = before + sum;
  barrier();  // sums before places are reserved
  if (gl_LocalInvocationIndex == 0u) reserve_cells();
  barrier();  // places before they are handed out

  if (strip == 0u && cell < CELLS) write_cell(cell, column);
  const bool fits = s_pieces[column] != ALL_LIGHTS;
  for (uint piece = strip; fits && piece < s_pieces[column]; piece += STRIPS)
    pieces[s_first_piece[column] + piece] = LightPiece(cell, s_begin[column] + piece * PIECE);
  for (uint block = from; block < to; block += HELD) {
    if (height > HELD) load_counts(cell, block, to, held);
    [[unroll]] for (uint k = 0u; k < HELD; ++k) {
      if (block + k >= to) continue;
      counts[(block + k) * CELLS + cell] = fits ? s_begin[column] + before : ENTRIES;
      before += held[k];
    }
  }
}
