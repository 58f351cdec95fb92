// The walk of a cell's flat bit array, in which bit N is light N.
// Needs: LOOKUP_WORDS of a cell, LOOKUP_BITS_VIEW; `lookup_bits`, lookup_cell of a view.
// SPDX-License-Identifier: Apache-2.0
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
