// One flat bit array a tile and depth range; bit N is light N.
// Based on: Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017).
// SPDX-License-Identifier: Apache-2.0
#include "lookup/parts/resources.glsl"

LOOKUP_CONSTANT(0, uint, LOOKUP_TILE_PX, 16);
LOOKUP_CONSTANT(1, uint, LOOKUP_WORDS, 1);
LOOKUP_CONSTANT(2, uint, LOOKUP_RANGES, 1);
LOOKUP_BUFFER(1, LookupBits, uint, lookup_bits);
LOOKUP_VIEW_WORDS(1, LOOKUP_BITS_VIEW);
LOOKUP_BUFFER(2, LookupSplits, float, lookup_splits);
LOOKUP_VIEW_WORDS(2, LOOKUP_SPLITS_VIEW);

#include "lookup/parts/tile_cell.glsl"

void lookup_prepare() {}

#include "lookup/parts/cell_bit_array.glsl"
