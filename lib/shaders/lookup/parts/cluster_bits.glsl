// Clusters, each one flat bit array; bit N is light N.
// Based on: Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017).
// SPDX-License-Identifier: Apache-2.0
#include "lookup/parts/cluster_cell.glsl"

LOOKUP_CONSTANT(5, uint, LOOKUP_WORDS, 1);
LOOKUP_BUFFER(1, LookupBits, uint, lookup_bits);

#define LOOKUP_LIGHT(bit) (bit)
#define LOOKUP_SPARSE
#include "lookup/parts/walk_bits.glsl"

Walk walk_begin(uvec2 pixel, float z_view) {
  return walk_bits(lookup_cell(pixel, z_view) * LOOKUP_WORDS, 0u, light_count_of(lookup_frame));
}

#define LOOKUP_RANGED
Walk walk_begin_in(uvec2 pixel, float z_view, uint first, uint end) {
  return walk_bits(lookup_cell(pixel, z_view) * LOOKUP_WORDS, first, min(end, light_count_of(lookup_frame)));
}
