// From counts to places: a group of columns (cells) of the count matrix, by one work group; each thread a strip of blocks.
// Cells get their entries in any order, a cell's own entries are in the order of the blocks.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
#include "common/frame.glsl"
#include "lamplight/shared/lamplight.h"

const uint COLUMNS = 16u;  // 64 bytes of a row
layout(local_size_x = 16, local_size_y_id = 0) in;
layout(constant_id = 0) const uint STRIPS = 16;
layout(constant_id = 1) const uint CELL_PX = 64;
layout(constant_id = 2) const uint LAYERS = 1;  // of cells
layout(constant_id = 3) const uint BLOCK = 256;
layout(constant_id = 4) const uint PIECES = 1;  // capacity
layout(constant_id = 5) const uint HITS = 1;    // capacity
layout(constant_id = 6) const uint CELL_ROWS = 16;
layout(constant_id = 7) const uint SCATTER_THREADS = 256;
layout(constant_id = 8) const uint ROW_GROUPS = 1;  // work groups of the last pass for a piece

layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) buffer CountBuffer { uint counts[]; };  // [block][cell]; becomes first places
layout(set = 0, binding = 2, scalar) writeonly buffer CellBuffer { LightCell cells[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer PieceBuffer { LightPiece cell_pieces[]; };
layout(set = 0, binding = 4, scalar) buffer TotalBuffer { LightTotals totals; };

uint cell_count() { return square_count(frame, CELL_PX) * LAYERS; }

shared uint s_strips[STRIPS][COLUMNS];
shared uint s_total[COLUMNS];
shared uint s_base;

uint pieces_of(uint entries) { return (entries + PIECE - 1u) / PIECE; }

// Whether pieces from `first` on are within the capacity.
bool has_pieces(uint first, uint entries) { return first <= PIECES && pieces_of(entries) <= PIECES - first; }

// Counts that a thread loads at once: their way from memory is most of the time.
const uint HELD = 16u;

void load_counts(uint cell, uint from, uint to, out uint held[HELD]) {
  [[unroll]] for (uint k = 0u; k < HELD; ++k) held[k] = from + k < to ? counts[(from + k) * cell_count() + cell] : 0u;
}

uint pieces_before(uint column) {
  uint sum = 0u;
  [[unroll]] for (uint c = 0u; c < COLUMNS; ++c) sum += c < column ? pieces_of(s_total[c]) : 0u;
  return sum;
}

// By one thread: room for the group's cells, whole pieces.
void reserve_pieces(uint wanted) {
  s_base = atomicAdd(totals.wanted_pieces, wanted);
  if (s_base > ENOUGH / PIECE) atomicMin(totals.wanted_pieces, ENOUGH / PIECE);
  atomicMax(totals.pieces, min(s_base + wanted, PIECES));
}

// By `threads` threads. A cell that does not fit leaves the pieces that there is room for to nobody.
void write_cell(uint cell, uint thread, uint threads, uint first_piece, uint entries, bool fits) {
  const uint end = min(first_piece + pieces_of(entries), PIECES);
  const LightPiece value = LightPiece(fits ? cell : NO_CELL, first_piece * PIECE, first_piece * PIECE + entries);
  for (uint piece = first_piece + thread; piece < end; piece += threads) cell_pieces[piece] = value;
  if (thread > 0u) return;
  cells[cell] = LightCell(first_piece, fits ? pieces_of(entries) : ALL_LIGHTS, entries);
  if (!fits) atomicAdd(totals.counters.overflowed_cells, CELL_ROWS);
}

// By one thread of all: what the next two passes are dispatched by, but for the pieces themselves.
void write_group_counts() {
  totals.lists_y = ROW_GROUPS;
  totals.lists_z = totals.scatter_y = totals.scatter_z = 1u;
  totals.scatter_x = (min(totals.hits, HITS) + SCATTER_THREADS - 1u) / SCATTER_THREADS;
}

void main() {
  const uint column = gl_LocalInvocationID.x;
  const uint strip = gl_LocalInvocationID.y;
  const uint cell = gl_WorkGroupID.x * COLUMNS + column;
  const uint blocks = (light_count_of(frame) + BLOCK - 1u) / BLOCK;
  const uint height = (blocks + STRIPS - 1u) / STRIPS;
  const uint from = cell < cell_count() ? min(strip * height, blocks) : 0u;
  const uint to = cell < cell_count() ? min(from + height, blocks) : 0u;
  const bool all_hits = totals.hits <= HITS;
  if (gl_WorkGroupID.x == 0u && gl_LocalInvocationIndex == 0u) write_group_counts();

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
  barrier();  // sums before room is reserved
  if (gl_LocalInvocationIndex == 0u) reserve_pieces(pieces_before(COLUMNS));
  barrier();  // room before it is handed out

  if (cell >= cell_count()) return;
  const uint first_piece = s_base + pieces_before(column);
  const bool fits = all_hits && has_pieces(first_piece, s_total[column]);
  write_cell(cell, strip, STRIPS, first_piece, s_total[column], fits);
  for (uint block = from; block < to; block += HELD) {
    if (height > HELD) load_counts(cell, block, to, held);
    [[unroll]] for (uint k = 0u; k < HELD; ++k) {
      if (block + k >= to) continue;
      counts[(block + k) * cell_count() + cell] = fits ? first_piece * PIECE + before : NO_PLACE;
      before += held[k];
    }
  }
}
