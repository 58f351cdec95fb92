// Hits as bits, where lights are few: a line for each cell, a bit for every light. A bit needs no room, no rank and no
// place, so nothing is left to scan or to scatter but the cells' counts, and those the work group that ends last turns
// into pieces.
// Needs: CELL_ROWS; `frame`, `totals`. Gives group_share, lights_to_find, light_to_find; keep_hit, keep_last_hits.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_BIT_HITS
#define LAMP_METHODS_LAMPLIGHT_BIT_HITS

layout(constant_id = 4) const uint SHARE = 32;           // lights of a work group
layout(constant_id = 5) const uint PIECES = 1;           // capacity
layout(constant_id = 6) const uint ROW_GROUPS = 1;       // work groups of the last pass for a piece
layout(constant_id = 7) const uint GROUP_THREADS = 256;  // of this one

layout(set = 0, binding = 4, scalar) coherent buffer BitBuffer { uint cell_bits[]; };  // [cell][word]
layout(set = 0, binding = 5, scalar) coherent buffer CellBuffer { LightCell cells[]; };
layout(set = 0, binding = 6, scalar) writeonly buffer PieceBuffer { LightPiece cell_pieces[]; };
#include "common/subgroup_scan.glsl"
#include "methods/lamplight_pieces.glsl"

shared uint s_is_last;

uint group_share() { return SHARE; }
uint lights_to_find() { return frame.light_count; }
uint light_to_find(uint i) { return i; }

void clear_hits() {}

// Each thread with a hit of its own, or none.
void keep_hit(bool is_hit, uint light, uint cell, inout uint waiting) {
  if (!is_hit) return;
  const uint words = (frame.light_count + 31u) / 32u;
  atomicOr(cell_bits[cell * words + light / 32u], 1u << (light % 32u));
  atomicAdd(cells[cell].entries, 1u);
}

// By all threads of a group together.
void hand_out_pieces() {
  const uint thread = scan_thread();
  const uint strip = (CELLS + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x;  // cells of a thread
  const uint from = min(thread * strip, CELLS);
  const uint to = min(from + strip, CELLS);
  uint own = 0u;
  for (uint cell = from; cell < to; ++cell) own += pieces_of(cells[cell].entries);
  uint first = subgroup_scan(own);
  for (uint cell = from; cell < to; ++cell) {
    const uint entries = cells[cell].entries;
    write_cell(cell, 0u, 1u, first, entries, has_pieces(first, entries));
    first += pieces_of(entries);
  }
  if (thread != gl_WorkGroupSize.x - 1u) return;
  totals.wanted_pieces = first;  // past its own: all of them
  totals.pieces = min(first, PIECES);
  totals.lists_y = ROW_GROUPS;
  totals.lists_z = 1u;
}

// By all threads of the group together.
void keep_last_hits(uint waiting) {
  memoryBarrierBuffer();
  barrier();  // every hit of the group before it counts as done
  if (gl_LocalInvocationIndex == 0u) {
    memoryBarrierBuffer();
    s_is_last = uint(atomicAdd(totals.find_done, 1u) + 1u == gl_NumWorkGroups.x);
    memoryBarrierBuffer();
  }
  barrier();
  if (s_is_last == 0u) return;
  memoryBarrierBuffer();  // every other group's hits before they are read
  hand_out_pieces();
}

#endif
