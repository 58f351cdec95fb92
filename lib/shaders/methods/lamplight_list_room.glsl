// Lists of a work group's rows: room for all of them together, then each in order. Threads are no fewer than rows.
// Needs: ROWS, CELL_ROWS, LIST_ENTRIES, MAY_WRAP; `totals`, `rows`; methods/lamplight_row_lists.glsl.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_LIST_ROOM
#define LAMP_METHODS_LAMPLIGHT_LIST_ROOM

shared uint s_list_size[ROWS];
shared uint s_list_begin[ROWS];
shared uint s_base;

// Room for all rows' lists together. By one thread; where the total could begin anew, after a look at it.
void reserve_lists(uint size) {
  const bool full = MAY_WRAP != 0u && totals.list_entries > LIST_ENTRIES;
  const uint begin = full ? LIST_ENTRIES : atomicAdd(totals.list_entries, size);
  s_base = size == 0u || (begin <= LIST_ENTRIES && size <= LIST_ENTRIES - begin) ? begin : ~0u;
}

// By all threads of the group together. Returns whether the lists fit; if not, the piece's lights stand for each of
// them.
bool write_lists(Cell cell, uint place, uint count) {
  const uint thread = gl_LocalInvocationIndex;
  const uint words = (count + 31u) / 32u;
  if (thread < ROWS) s_list_size[thread] = lights_before(thread, words);
  barrier();  // sizes before they are added up
  if (thread < ROWS) {
    uint before = 0u;
    for (uint i = 0u; i < thread; ++i) before += s_list_size[i];
    s_list_begin[thread] = before;
    if (thread == ROWS - 1u) reserve_lists(before + s_list_size[thread]);
  }
  barrier();  // places before lists are written
  const bool fits = s_base != ~0u;
  for (uint i = thread; fits && i < ROWS * words; i += gl_WorkGroupSize.x)
    write_list_word(i % ROWS, i / ROWS, s_base + s_list_begin[i % ROWS]);
  if (thread < ROWS) {
    const uint at = 2u * (place * CELL_ROWS + cell.first_row + thread);
    rows[at] = fits ? s_base + s_list_begin[thread] : place * PIECE | COARSE;
    rows[at + 1u] = fits ? s_list_size[thread] : count;
  }
  if (!fits && thread == 0u) atomicAdd(totals.counters.overflowed_cells, ROWS);
  return fits;
}

#endif
