// One flat bit array a tile and depth range; bit N is light N.
// Based on: Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017).
// SPDX-License-Identifier: Apache-2.0
#include "lookup/parts/resources.glsl"

LOOKUP_CONSTANT(0, uint, LOOKUP_TILE_PX, 16);
LOOKUP_CONSTANT(1, uint, LOOKUP_WORDS, 1);
LOOKUP_CONSTANT(2, uint, LOOKUP_RANGES, 1);
LOOKUP_BUFFER(1, LookupBits, uint, lookup_bits);
LOOKUP_BUFFER(2, LookupSplits, float, lookup_splits);

#include "lookup/parts/tile_cell.glsl"
#define LOOKUP_LIGHT(bit) (bit)
#define LOOKUP_SPARSE
#include "lookup/parts/walk_bits.glsl"

void lookup_prepare() {}

Walk walk_begin(uvec2 pixel, float z_view) {
  return walk_bits(lookup_cell(pixel, z_view) * LOOKUP_WORDS, 0u, light_count_of(lookup_frame));
}

#define LOOKUP_RANGED
Walk walk_begin_in(uvec2 pixel, float z_view, uint first, uint end) {
  return walk_bits(lookup_cell(pixel, z_view) * LOOKUP_WORDS, first, min(end, light_count_of(lookup_frame)));
}
