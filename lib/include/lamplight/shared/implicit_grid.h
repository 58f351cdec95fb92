// What the passes of `ikkala-grid` hand on: where slices lie, lights' ranges of slices, bits in blocks of lights.
// Promise: the same numbers in C++ plans, in GLSL and in HLSL.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMPLIGHT_SHARED_IMPLICIT_GRID_H
#define LAMPLIGHT_SHARED_IMPLICIT_GRID_H

#include "glsl.h"

#ifdef __cplusplus
namespace lamp::shared {
#endif

// Along each axis the world is cut into slices, and a cell is where three slices meet. The first and the last slice
// reach to infinity. Behind the last is one more, of coordinates that are no finite number.
struct ImplicitGrid {
  vec3 low;  // m, where slices are counted from
  uint reserved1;
  vec3 slices_a_metre;  // > 0
  uint reserved2;
};

// The lights' bounds while they are gathered, zeroed at the start of every frame. Of each axis the complement of the
// least ordered coordinate, then of each the greatest; 0: no light (common/implicit_grid.glsl).
LAMP_CONST GRID_EXTENT_WORDS = 6u;

// Each slice has a bit for each light. Blocks of lights have a word of their own, with a bit for each word of bits.
LAMP_CONST GRID_BLOCK = 1024u;
LAMP_CONST GRID_BLOCK_WORDS = 32u;
// Slices whose bits of a block one work group makes.
LAMP_CONST GRID_GROUP_SLICES = 64u;

// A light's slices along an axis: the first, and from this bit on the last.
LAMP_CONST GRID_LAST_SHIFT = 16u;
LAMP_CONST GRID_NO_SLICES = 0xffffu;  // the first is behind the last
LAMP_CONST GRID_MOST_SLICES = 1024u;

// Keys that lights are sorted by: along a space-filling curve, those that fill much of the grid before all others.
LAMP_CONST GRID_CURVE_BITS = 5u;  // of each axis
LAMP_CONST GRID_KEY_BITS = 16u;
LAMP_CONST GRID_LARGE_SHARE = 8u;  // as much of an axis as the grid's side over this is much

#ifdef __cplusplus
static_assert(sizeof(ImplicitGrid) == 32);
static_assert(GRID_BLOCK == 32 * GRID_BLOCK_WORDS && 3 * GRID_CURVE_BITS + 1 == GRID_KEY_BITS);
}  // namespace lamp::shared
#endif

#endif
