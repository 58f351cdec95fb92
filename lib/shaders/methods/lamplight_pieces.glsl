// Cells get their pieces: a whole number of them for each cell's lights, the last one filled in part.
// Needs: PIECES, CELL_ROWS; `cells`, `cell_pieces`, `totals`.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_PIECES
#define LAMP_METHODS_LAMPLIGHT_PIECES

uint pieces_of(uint entries) { return (entries + PIECE - 1u) / PIECE; }

// Whether pieces from `first` on are within the capacity.
bool has_pieces(uint first, uint entries) { return first <= PIECES && pieces_of(entries) <= PIECES - first; }

// By `threads` threads. A cell that does not fit leaves the pieces that there is room for to nobody.
void write_cell(uint cell, uint thread, uint threads, uint first_piece, uint entries, bool fits) {
  const uint end = min(first_piece + pieces_of(entries), PIECES);
  const LightPiece value = LightPiece(fits ? cell : NO_CELL, first_piece * PIECE, first_piece * PIECE + entries);
  for (uint piece = first_piece + thread; piece < end; piece += threads) cell_pieces[piece] = value;
  if (thread > 0u) return;
  cells[cell] = LightCell(first_piece, fits ? pieces_of(entries) : ALL_LIGHTS, entries);
  if (!fits) atomicAdd(totals.counters.overflowed_cells, CELL_ROWS);
}

#endif
