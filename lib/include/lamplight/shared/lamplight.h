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

// What of a tile's depth culling looks at.
struct TileDepths {
  float z_near;  // m; > z_far if the tile is empty
  float z_far;   // m
  uint mask;     // bit i: a pixel lies in part i of 32 equal ones between z_near and z_far
  uint reserved;
};

// Where on screen a light's bounding sphere lies. Tiles as y << 16 | x.
struct LightReach {
  uint first;  // tile
  uint last;   // tile; and REACH_OF_SPOT
};
LAMP_CONST REACHES_NO_TILE = 0xffffffffu;  // in `first`
LAMP_CONST REACH_OF_SPOT = 0x80000000u;    // in `last`

// A cell is a square of tiles. Its lights ascend through its pieces, which are culled by one work group each.
struct LightCell {
  uint first_piece;
  uint pieces;  // ALL_LIGHTS: its entries did not fit; walk every light
  uint end;     // of its entries
};
LAMP_CONST ALL_LIGHTS = 0xffffffffu;

struct LightPiece {
  uint cell;
  uint begin;  // of its entries; PIECE of them, or fewer at the end of the cell
};

// A tile's part of a piece.
struct LightSpan {
  uint first;  // in the lists, or with COARSE in the lists of pieces
  uint count;
};
LAMP_CONST COARSE = 0x80000000u;  // the piece's lists did not fit: all lights of the piece stand for each of its tiles

// Zeroed at the start of every frame.
struct LightTotals {
  uint pieces;  // these three are the group counts of the last pass
  uint one_y;
  uint one_z;
  uint entry_units;  // rooms of ENTRY_UNIT entries: their sum has 32 bits where that of entries has not
  uint list_entries;
};
LAMP_CONST ENTRY_UNIT = 64u;

#ifdef __cplusplus
static_assert(sizeof(TileDepths) == 16 && sizeof(LightReach) == 8 && sizeof(LightCell) == 12 &&
              sizeof(LightPiece) == 8 && sizeof(LightSpan) == 8 && sizeof(LightTotals) == 20);
}  // namespace lamp::shared
#endif
#undef LAMP_CONST

#endif
