// What a work group of the last pass looks at: some of a cell's entries, by some of its own rows.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_CELL_PIECE
#define LAMP_METHODS_LAMPLIGHT_CELL_PIECE

struct CellPiece {
  uint cell;   // NO_CELL: there is none
  uint begin;  // of its entries
  uint count;  // of them
  uint place;  // among all pieces
  uint row;    // of the group's, where they begin
  uint rows;
};

shared CellPiece s_piece;  // for when all tests are done: these need every register

#endif
