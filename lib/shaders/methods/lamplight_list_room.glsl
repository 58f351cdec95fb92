// Lists of a work group's rows: room for all of them together, then each in order. Threads are no fewer than rows.
// Needs: ROWS, LIST_ENTRIES; `totals`, `rows`; CellPiece; methods/lamplight_row_lists.glsl.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_LIST_ROOM
#define LAMP_METHODS_LAMPLIGHT_LIST_ROOM
#extension GL_KHR_shader_subgroup_shuffle : require
#include "common/subgroup_sum.glsl"

shared uint s_list_size[ROWS];
shared uint s_list_begin[ROWS];
shared uint s_base;

// Room for all rows' lists together. By one thread.
void reserve_lists(uint size) {
  const uint begin = atomicAdd(totals.list_entries, size);
  if (begin > ENOUGH) atomicMin(totals.list_entries, ENOUGH);
  s_base = size == 0u || (begin <= LIST_ENTRIES && size <= LIST_ENTRIES - begin) ? begin : ~0u;
}

// By one subgroup: sizes and places of all lists, from the marks.
void place_lists(uint row_count, uint words) {
  uint before = 0u;
  for (uint first = 0u; first < row_count; first += gl_SubgroupSize) {
    const uint row = first + gl_SubgroupInvocationID;
    const uint size = row < row_count ? lights_before(row, words) : 0u;
    const uint end = inclusive_sum(size);
    if (row < row_count) {
      s_list_size[row] = size;
      s_list_begin[row] = before + end - size;
    }
    before += subgroupShuffle(end, gl_SubgroupSize - 1u);
  }
  if (subgroupElect()) reserve_lists(before);
}

// By all threads of the group together: of the piece, whose rows are those from `first_row` on of all. Returns whether
// the lists fit; if not, the piece's lights stand for each of them.
bool write_lists(CellPiece piece, uint first_row) {
  const uint thread = gl_LocalInvocationIndex;
  const uint words = (piece.count + 31u) / 32u;
  if (gl_SubgroupID == 0u) place_lists(piece.rows, words);
  barrier();  // places before lists are written
  const bool fits = s_base != ~0u;
  for (uint i = thread; fits && i < piece.rows * words * WORD_PARTS; i += gl_WorkGroupSize.x) {
    const uint row = i & piece.rows - 1u;
    write_list_part(row, i >> findMSB(piece.rows), s_base + s_list_begin[row]);
  }
  if (thread < piece.rows) {
    const uint at = 2u * (first_row + thread);
    rows[at] = fits ? s_base + s_list_begin[thread] : piece.place * PIECE | COARSE;
    rows[at + 1u] = fits ? s_list_size[thread] : piece.count;
  }
  if (!fits && thread == 0u) atomicAdd(totals.counters.overflowed_cells, piece.rows);
  return fits;
}

#endif
