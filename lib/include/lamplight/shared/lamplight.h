// What the passes of `lamplight` hand on: cells, pieces of a cell's lights, running totals.
// Promise: the same bytes in C++ plans and in GLSL.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMPLIGHT_SHARED_LAMPLIGHT_H
#define LAMPLIGHT_SHARED_LAMPLIGHT_H

#include "glsl.h"

#ifdef __cplusplus
namespace lamp::shared {
#define LAMP_CONST inline constexpr uint
#else
#define LAMP_CONST const uint
#endif

// A cell is a square of tiles. Its lights ascend through its pieces, which are culled by one work group each.
struct LightCell {
  uint first_piece;
  uint pieces;  // ALL_LIGHTS: its entries did not fit; walk every light
  uint end;     // of its entries
};
LAMP_CONST ALL_LIGHTS = 0xffffffffu;

struct LightPiece {
  uint cell;
  uint begin;  // of its entries; it ends where the next piece of the cell begins, or with the cell
};

// A tile's part of a piece.
struct LightSpan {
  uint first;  // in the lists, or with COARSE in the entries
  uint count;
};
LAMP_CONST COARSE = 0x80000000u;  // the piece's lists did not fit: all lights of the piece stand for each of its tiles

// Zeroed at the start of every frame.
struct LightTotals {
  uint pieces;  // these three are the group counts of the last pass
  uint one_y;
  uint one_z;
  uint entries;
  uint list_entries;
};

#ifdef __cplusplus
static_assert(sizeof(LightCell) == 12 && sizeof(LightPiece) == 8 && sizeof(LightSpan) == 8 &&
              sizeof(LightTotals) == 20);
}  // namespace lamp::shared
#endif
#undef LAMP_CONST

#endif
