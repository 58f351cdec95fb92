// Clusters, each one flat bit array; bit N is light N.
// Based on: Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017).
// SPDX-License-Identifier: Apache-2.0
#include "lookup/parts/cluster_cell.glsl"

LOOKUP_CONSTANT(5, uint, LOOKUP_WORDS, 1);
LOOKUP_BUFFER(1, LookupBits, uint, lookup_bits);
LOOKUP_VIEW_WORDS(1, LOOKUP_BITS_VIEW);

#define LOOKUP_LIGHT(walk, bit) (bit)
#define LOOKUP_SPARSE
#include "lookup/parts/walk_bits.glsl"

uint lookup_first_word(uint view, uvec2 pixel, float z_view) {
  return view * LOOKUP_BITS_VIEW + lookup_cell(view, pixel, z_view) * LOOKUP_WORDS;
}

Walk walk_begin(uint view, uvec2 pixel, float z_view) {
  return walk_bits(lookup_first_word(view, pixel, z_view), 0u, lookup_light_count());
}

#define LOOKUP_RANGED
Walk walk_begin_in(uint view, uvec2 pixel, float z_view, uint first, uint end) {
  return walk_bits(lookup_first_word(view, pixel, z_view), first, min(end, lookup_light_count()));
}
#include "lookup/parts/of_view.glsl"
