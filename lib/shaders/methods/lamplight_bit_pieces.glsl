// Which pieces of which cells a work group takes, where cells have bits. The first CELLS groups take each cell's first
// piece, which is kept at the cell's own place. The others take in turns what cells have beyond it. They learn that from
// the counts of all cells, each for itself: a pass that does it once for all takes longer.
// Needs: CELL_ROWS; `cells`, `totals`. Gives further_piece.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_BIT_PIECES
#define LAMP_METHODS_LAMPLIGHT_BIT_PIECES

layout(constant_id = 10) const uint GROUP_THREADS = 256;
layout(constant_id = 11) const uint PIECES = 1;  // capacity, at least CELLS
layout(constant_id = 12) const uint CELLS = 1;
#include "common/subgroup_scan.glsl"

struct CellPiece {
  uint cell;    // NO_CELL: there is none
  uint number;  // among the cell's pieces
  uint place;   // among all
};

shared CellPiece s_piece;

// Pieces beyond the first.
uint further_pieces(uint cell) { return (max(cells[cell].entries, 1u) - 1u) / PIECE; }

// For the look-up, of a cell with further pieces, of which all cells before have `first`.
void write_cell(uint cell, uint first, uint further, bool fits) {
  cells[cell].first_piece = CELLS + first;
  cells[cell].pieces = fits ? further + 1u : ALL_LIGHTS;
  if (!fits) atomicAdd(totals.counters.overflowed_cells, CELL_ROWS);
}

// By all threads of the group together: the further piece of that number among those of all cells. If `writes`, all
// cells that have some are written as well.
CellPiece further_piece(uint number, bool writes) {
  const uint thread = scan_thread();
  const uint strip = (CELLS + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x;  // cells of a thread
  const uint from = min(thread * strip, CELLS);
  const uint to = min(from + strip, CELLS);
  if (thread == 0u) s_piece.cell = NO_CELL;
  uint own = 0u;
  for (uint cell = from; cell < to; ++cell) own += further_pieces(cell);
  uint first = subgroup_scan(own);
  const bool has_it = number >= first && number - first < own;
  if (writes && thread == gl_WorkGroupSize.x - 1u) totals.wanted_pieces = CELLS + first + own;
  for (uint cell = from; cell < to && (has_it || writes); ++cell) {
    const uint further = further_pieces(cell);
    const bool fits = first + further <= PIECES - CELLS;
    if (writes && further > 0u) write_cell(cell, first, further, fits);
    if (fits && number - first < further) s_piece = CellPiece(cell, number - first + 1u, CELLS + number);
    first += further;
  }
  barrier();  // the piece is found
  return s_piece;
}

#endif
