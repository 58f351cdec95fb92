// Which work group takes what, where cells have bits. The last groups, as many as cells, take a cell's first piece each. The others
// take what is shared out, and begin first, so that nobody waits for them in the end. If crowded cells have few pieces
// in all, these are all shared out, each in PARTS parts of its rows: they are what the pass would wait for. If there
// are more parts than groups, only pieces beyond a cell's first are shared out, whole, and groups take them in turns.
// Which it is they learn from the counts of all cells, each for itself: a pass that does it once for all takes longer.
// Needs: ROWS, CELL_ROWS; `cells`, `totals`; s_piece. Gives share_pieces.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_BIT_PIECES
#define LAMP_METHODS_LAMPLIGHT_BIT_PIECES
#extension GL_EXT_control_flow_attributes : require

layout(constant_id = 10) const uint MOST_SUBGROUPS = 64;  // of a work group
layout(constant_id = 11) const uint PIECES = 1;  // capacity, at least one a cell
layout(constant_id = 12) const uint LAYERS = 1;  // of cells
layout(constant_id = 13) const uint CROWDED = ~0u;    // a cell of more lights is; ~0: none is
layout(constant_id = 14) const uint PARTS = 1;        // a power of two
#include "common/subgroup_scan.glsl"

#include "methods/lamplight_cell_count.glsl"

const uint NO_GROUP = ~0u;  // takes nothing

bool is_crowded(uint entries) { return entries > CROWDED; }

// Counts that a thread holds, so that it need not load them twice: all that it looks at, where cells are few.
const uint HELD_CELLS = 2u;

void load_counts(uint from, uint to, out uint held[HELD_CELLS]) {
  [[unroll]] for (uint k = 0u; k < HELD_CELLS; ++k) held[k] = from + k < to ? cells[from + k].entries : 0u;
}

// All of a crowded cell; beyond the first of any cell.
uvec2 pieces_of(uint entries) {
  const uint pieces = (entries + PIECE - 1u) / PIECE;
  return uvec2(is_crowded(entries) ? pieces : 0u, max(pieces, 1u) - 1u);
}

// For the look-up, of a cell with further pieces, of which all cells before have `first`.
void write_cell(uint cell, uint first, uint further, bool fits) {
  cells[cell].first_piece = cell_count() + first;
  cells[cell].pieces = fits ? further + 1u : ALL_LIGHTS;
  if (!fits) atomicAdd(totals.counters.overflowed_cells, CELL_ROWS);
}

// Piece `number` of the cell, the group's part of it if all are shared out; `first`: further pieces of cells before.
CellPiece part_of_piece(uint cell, uint entries, uint number, uint first, bool all, uint group) {
  const uint count = min(entries - number * PIECE, PIECE);
  const uint place = number == 0u ? cell : cell_count() + first + number - 1u;
  const uint rows = all ? ROWS / PARTS : ROWS;
  return CellPiece(cell, number * PIECE, count, place, all ? group % PARTS * rows : 0u, rows);
}

// By all threads of the group together: s_piece becomes what the group with that number of `groups` takes, if there is
// something. Returns whether all pieces of crowded cells are shared out. If `writes`, all cells with further pieces are
// written as well.
bool share_pieces(uint group, uint groups, bool writes) {
  const uint thread = scan_thread();
  const uint strip = (cell_count() + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x;  // cells of a thread
  const uint from = min(thread * strip, cell_count());
  const uint to = min(from + strip, cell_count());
  uint held[HELD_CELLS];
  uvec2 own = uvec2(0u);
  for (uint at = 0u; at < strip; at += HELD_CELLS) {
    load_counts(from + at, to, held);
    [[unroll]] for (uint k = 0u; k < HELD_CELLS; ++k) own += pieces_of(held[k]);
  }
  uvec2 total;
  uvec2 first = subgroup_scan(own, total);
  const bool all = CROWDED != ~0u && total.x <= groups / PARTS;
  if (writes && thread == 0u) totals.wanted_pieces = cell_count() + total.y;
  const uint wanted = all ? group / PARTS : group;
  const bool has_it = group != NO_GROUP && wanted - (all ? first.x : first.y) < (all ? own.x : own.y);
  for (uint at = 0u; at < strip && (has_it || writes); at += HELD_CELLS) {
    if (strip > HELD_CELLS) load_counts(from + at, to, held);
    [[unroll]] for (uint k = 0u; k < HELD_CELLS; ++k) {
      const uvec2 pieces = pieces_of(held[k]);
      const bool fits = pieces.y == 0u || first.y + pieces.y <= PIECES - cell_count();
      if (writes && pieces.y > 0u) write_cell(from + at + k, first.y, pieces.y, fits);
      const uint number = wanted - (all ? first.x : first.y);
      if (fits && number < (all ? pieces.x : pieces.y))
        s_piece = part_of_piece(from + at + k, held[k], all ? number : number + 1u, first.y, all, group);
      first += pieces;
    }
  }
  barrier();  // the piece is found
  return all;
}

#endif
