// What the passes of `lamplight` hand on: cells, pieces of a cell's lights, running totals.
// Promise: the same bytes in C++ plans and in GLSL.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMPLIGHT_SHARED_LAMPLIGHT_H
#define LAMPLIGHT_SHARED_LAMPLIGHT_H

#include "counters.h"
#include "glsl.h"

#ifdef __cplusplus
namespace lamp::shared {
#endif

// What of a tile's depth culling looks at.
struct TileDepths {
  float z_near;  // m; > z_far if the tile is empty
  float z_far;   // m
  float scale;   // parts a metre
  uint mask;     // bit i: a pixel lies in part i of 32 equal ones between z_near and z_far
};

// A light that may reach a cell, of those whose cells have lists.
struct LightHit {
  uint light;
  uint place;  // cell, and above HIT_CELL_BITS the rank among the hits of the same block of lights in the same cell
};
LAMP_CONST HIT_CELL_BITS = 19u;  // eight layers of cells of 32 x 32 tiles of 8 pixels in a picture of 65536 x 65536

LAMP_CONST PIECE = 128u;      // entries
LAMP_CONST PIECE_WORDS = 4u;  // a bit for each of them

// A cell is a square of tiles, or without depth buffer such a square times some slices of depth. Its rows are its
// tiles, slice after slice. Its lights ascend through its pieces: piece i has room for PIECE of them from i * PIECE.
// Where cells have bits, or all is one pass, a cell's first piece is that of the cell's own number.
struct LightCell {
  uint first_piece;  // or the second, where the first is known
  uint pieces;       // ALL_LIGHTS: its entries did not fit; walk every light
  uint entries;      // lights
};
LAMP_CONST ALL_LIGHTS = 0xffffffffu;
LAMP_CONST NO_PLACE = 0xffffffffu;  // of its entries

// What the last pass needs of a piece's cell.
struct LightPiece {
  uint cell;   // NO_CELL: of a cell that did not fit
  uint begin;  // entries of the cell
  uint end;
};
LAMP_CONST NO_CELL = 0xffffffffu;

// A row's part of a piece, as a list. As bits it is PIECE_WORDS words.
struct LightSpan {
  uint first;  // in the lists, or with COARSE in the lists of pieces
  uint count;
};
LAMP_CONST COARSE = 0x80000000u;  // the piece's lists did not fit: all lights of the piece stand for each of its rows

// Zeroed at the start of every frame.
struct LightTotals {
  Counters counters;
  uint pieces;  // these three are the group counts of the last pass, of cells with lists
  uint lists_y;
  uint lists_z;
  uint find_x;  // and these of the pass that finds cells
  uint find_y;
  uint find_z;
  uint scatter_x;  // and these of scattering
  uint scatter_y;
  uint scatter_z;
  uint seen;  // lights in view
  // Whether there is room or not; each may stop to grow at ENOUGH.
  uint hits;  // pairs of light and cell
  uint wanted_pieces;
  uint list_entries;
};

// Totals have 32 bits, what is needed may be more. Who finds that a total was beyond this puts it back: it is more than
// any capacity, and leaves all groups that a GPU runs at once room to add to it in the meantime.
LAMP_CONST ENOUGH = 0x80000000u;  // entries

#ifdef __cplusplus
static_assert(sizeof(TileDepths) == 16 && sizeof(LightHit) == 8 && sizeof(LightCell) == 12 &&
              sizeof(LightPiece) == 12 && sizeof(LightSpan) == 8 && sizeof(LightTotals) == 68);
}  // namespace lamp::shared
#endif

#endif
