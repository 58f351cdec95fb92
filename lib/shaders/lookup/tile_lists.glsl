// Look-up: one list a tile and depth range; each thread walks its own.
// SPDX-License-Identifier: Apache-2.0
#include "lookup/parts/tile_lists.glsl"
#define LOOKUP_TOGETHER (LOOKUP_RANGES == 1u)
