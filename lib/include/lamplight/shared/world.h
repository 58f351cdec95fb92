// What the passes of `world-cells` hand on: buckets of bricks of cells, pieces of a bucket's lights, running totals.
// Promise: the same bytes in C++ plans, in GLSL and in HLSL.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMPLIGHT_SHARED_WORLD_H
#define LAMPLIGHT_SHARED_WORLD_H

#include "counters.h"
#include "glsl.h"

#ifdef __cplusplus
namespace lamp::shared {
#endif

// A brick is a cube of 4 x 4 x 4 cells, or of 16 x 16 x 16. The bricks of level 0 have a side of 2^-WORLD_LEAST m,
// those of the next level twice that, and so on; one corner of each level lies at the world's origin. A light is listed
// at one level, by its range. Beyond all levels is one brick that is the whole world.
LAMP_CONST BRICK_CELLS = 4u;    // along each axis, with a bit for each cell,
LAMP_CONST BRICK_SLICES = 16u;  // or with one for each slice: a cell is where three of them meet
LAMP_CONST CELL_HALVES = 4u;    // halves of a word that these bits take
LAMP_CONST SLICE_HALVES = 3u;
LAMP_CONST WORLD_LEVELS = 20u;
LAMP_CONST WORLD_EVERYTHING = WORLD_LEVELS;  // the level of the brick that is the whole world
LAMP_CONST WORLD_LEAST = 5u;                 // 2^-5 m to 2^14 m
LAMP_CONST WORLD_STREAMS = 4u;               // levels whose cells a walk keeps in registers; it searches further ones

// Farthest brick from the origin, in bricks: rounding widens a light's sphere so that none is listed farther out.
LAMP_CONST_FLOAT WORLD_FARTHEST = 4194304.0f;

// An entry is a light and, in its low bits, the code of the brick that it is listed for: the remainders of the brick's
// coordinates. They tell a light's bricks apart, and nearly always bricks that share a bucket.
LAMP_CONST ENTRY_CODE_BITS = 8u;
LAMP_CONST MOST_BRICKS_ACROSS = 6u;  // of a light; divides the coordinates

// Bricks with the same hash share a bucket: a walk passes over the entries of others. Its entries ascend from `first`
// on. Their bits begin where those of all entries before end, in blocks of 32 entries: in a block of n entries each
// cell has n bits, one cell behind the other; or each slice, those along x before those along y and z.
struct WorldBucket {
  uint first;  // even, where slices have bits: their bits begin with a word
  uint count;  // WORLD_ALL: did not fit; walk every light
};
LAMP_CONST WORLD_ALL = 0xffffffffu;

// Short buckets are put in order by the work group in whose window of entries they begin. Entries of a longer one that
// one work group puts in order:
LAMP_CONST WORLD_PIECE = 384u;
struct WorldPiece {
  uint bucket;
  uint begin;  // the piece's first entry among the bucket's
};

// Work groups are numbered x + WORLD_GROUPS_ACROSS * y: a device may take no more than 65535 along one axis.
LAMP_CONST WORLD_GROUPS_ACROSS = 32768u;

// Zeroed at the start of every frame.
struct WorldTotals {
  Counters counters;
  uint pieces;    // of buckets that are not short
  uint pieces_x;  // their group counts
  uint pieces_y;
  uint pieces_z;
  uint order_x;  // group counts of pieces and of the entries' windows
  uint order_y;
  uint order_z;
  uint is_unkept;  // not 0: there was no room for all that was found
};

// A light that was counted, by a group that counts those of up to 2^FOUND_LIGHT_BITS lights.
LAMP_CONST FOUND_LIGHT_BITS = 12u;
struct WorldFound {
  uint bucket_light;  // the light's place among the group's in the low FOUND_LIGHT_BITS
  uint rank_code;     // how many of the bucket were counted before; the brick's code in the low ENTRY_CODE_BITS
};

#ifdef __cplusplus
static_assert(sizeof(WorldBucket) == 8 && sizeof(WorldPiece) == 8 && sizeof(WorldFound) == 8 &&
              sizeof(WorldTotals) == 48);
static_assert(WORLD_PIECE % 32 == 0);  // its blocks of entries are full ones
static_assert(CELL_HALVES * 16 == BRICK_CELLS * BRICK_CELLS * BRICK_CELLS);
static_assert(SLICE_HALVES * 16 == 3 * BRICK_SLICES);
static_assert(MOST_BRICKS_ACROSS * MOST_BRICKS_ACROSS * MOST_BRICKS_ACROSS <= 1U << ENTRY_CODE_BITS);
}  // namespace lamp::shared
#endif

#endif
