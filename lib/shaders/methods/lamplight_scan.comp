// From counts to places: a group of columns (cells) of the count matrix, by one work group; each thread a strip of blocks.
// Cells get their entries in any order, a cell's own entries are in the order of the blocks. Also cuts cells into pieces
// of about PIECE entries, at the borders of blocks.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lamplight/shared/counters.h"
#include "lamplight/shared/frame.h"
#include "lamplight/shared/lamplight.h"

const uint COLUMNS = 16u;
const uint STRIPS = 16u;
layout(local_size_x = 16, local_size_y = 16) in;
layout(constant_id = 0) const uint CELLS = 1;
layout(constant_id = 1) const uint BLOCK = 256;
layout(constant_id = 2) const uint PIECE = 1024;
layout(constant_id = 3) const uint ENTRIES = 1;  // capacity
layout(constant_id = 4) const uint TILES = 16;   // of a cell

layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) buffer CountBuffer { uint counts[]; };  // [block][cell]; becomes first places
layout(set = 0, binding = 2, scalar) writeonly buffer CellBuffer { LightCell cells[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer PieceBuffer { LightPiece pieces[]; };
layout(set = 0, binding = 4, scalar) buffer TotalBuffer { LightTotals totals; };
layout(set = 0, binding = 5, scalar) buffer CounterBuffer { Counters counters; };

shared uint s_strips[STRIPS][COLUMNS];
shared uint s_begin[COLUMNS];
shared uint s_first_piece[COLUMNS];
shared uint s_pieces[COLUMNS];

// Adds, but stays at the largest number instead of beginning anew. Returns the old total.
uint reserve_entries(uint count) {
  uint expected = totals.entries;
  for (;;) {
    const uint sum = expected > ~0u - count ? ~0u : expected + count;
    const uint found = atomicCompSwap(totals.entries, expected, sum);
    if (found == expected) return expected;
    expected = found;
  }
}

// By one thread: places and pieces of the group's cells. Sums of 16 cells of up to 2^24 lights stay below 2^32.
void reserve_cells(uint first_cell, uint totals_of[COLUMNS]) {
  uint entries = 0u;
  uint wanted_pieces = 0u;
  for (uint c = 0u; c < COLUMNS; ++c) {
    s_begin[c] = entries;
    entries += totals_of[c];
  }
  const uint begin = reserve_entries(entries);
  for (uint c = 0u; c < COLUMNS; ++c) {
    const bool fits = begin <= ENTRIES && s_begin[c] + totals_of[c] <= ENTRIES - begin;
    s_begin[c] = fits ? begin + s_begin[c] : ENTRIES;
    s_pieces[c] = !fits ? ALL_LIGHTS : totals_of[c] == 0u ? 0u : (totals_of[c] - 1u) / PIECE + 1u;
    s_first_piece[c] = wanted_pieces;
    if (fits) wanted_pieces += s_pieces[c];
    if (!fits && first_cell + c < CELLS) atomicAdd(counters.overflowed_cells, TILES);
  }
  const uint first_piece = atomicAdd(totals.pieces, wanted_pieces);
  for (uint c = 0u; c < COLUMNS; ++c) {
    s_first_piece[c] += first_piece;
    if (first_cell + c >= CELLS) continue;
    const uint end = s_pieces[c] == ALL_LIGHTS ? ENTRIES : s_begin[c] + totals_of[c];
    cells[first_cell + c] = LightCell(s_first_piece[c], s_pieces[c], end);
    if (s_pieces[c] != 0u && s_pieces[c] != ALL_LIGHTS)
      pieces[s_first_piece[c]] = LightPiece(first_cell + c, s_begin[c]);
  }
}

void main() {
  const uint column = gl_LocalInvocationID.x;
  const uint strip = gl_LocalInvocationID.y;
  const uint first_cell = gl_WorkGroupID.x * COLUMNS;
  const uint cell = first_cell + column;
  const uint blocks = (frame.light_count + BLOCK - 1u) / BLOCK;
  const uint height = (blocks + STRIPS - 1u) / STRIPS;
  const uint from = cell < CELLS ? min(strip * height, blocks) : 0u;
  const uint to = cell < CELLS ? min(from + height, blocks) : 0u;
  if (gl_WorkGroupID.x == 0u && gl_LocalInvocationIndex == 0u) totals.one_y = totals.one_z = 1u;

  uint sum = 0u;
  for (uint block = from; block < to; ++block) sum += counts[block * CELLS + cell];
  s_strips[strip][column] = sum;
  barrier();  // all strips before they are added up
  uint before = 0u;
  for (uint i = 0u; i < strip; ++i) before += s_strips[i][column];
  if (gl_LocalInvocationIndex == 0u) {
    uint totals_of[COLUMNS];
    for (uint c = 0u; c < COLUMNS; ++c) {
      totals_of[c] = 0u;
      for (uint i = 0u; i < STRIPS; ++i) totals_of[c] += s_strips[i][c];
    }
    reserve_cells(first_cell, totals_of);
  }
  barrier();  // places before they are handed out

  const bool fits = s_pieces[column] != ALL_LIGHTS;
  for (uint block = from; block < to; ++block) {
    const uint count = counts[block * CELLS + cell];
    counts[block * CELLS + cell] = fits ? s_begin[column] + before : ENTRIES;
    // The block after this one begins the pieces whose first entry lies in this one.
    const uint last_piece = min((before + count) / PIECE, max(s_pieces[column], 1u) - 1u);
    for (uint piece = before / PIECE + 1u; fits && piece <= last_piece; ++piece)
      pieces[s_first_piece[column] + piece] = LightPiece(cell, s_begin[column] + before + count);
    before += count;
  }
}
