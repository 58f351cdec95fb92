// The bits of a pixel's tile between the least and the greatest light of the pixel's bin. Bits are in the order of depth.
// Based on: Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017), Z-binning.
// SPDX-License-Identifier: Apache-2.0
#include "lookup/parts/resources.glsl"

LOOKUP_CONSTANT(0, uint, LOOKUP_TILE_PX, 8);
LOOKUP_CONSTANT(1, uint, LOOKUP_WORDS, 1);
LOOKUP_CONSTANT(6, bool, LOOKUP_WIDE, false);
LOOKUP_BUFFER(1, LookupBits, uint, lookup_bits);
LOOKUP_BUFFER(2, LookupBins, uint, lookup_bins);
LOOKUP_BUFFER(3, LookupOrder, uint, lookup_order);
LOOKUP_VIEW_WORDS(1, LOOKUP_BITS_VIEW);
LOOKUP_VIEW_WORDS(2, LOOKUP_BINS_VIEW);
LOOKUP_VIEW_WORDS(3, LOOKUP_ORDER_VIEW);

#define LOOKUP_SLICE_CONSTANT 2
#include "lookup/parts/slice_constants.glsl"

// The view of a walk follows from where its words are.
uint lookup_order_first(uint word) {
  return LOOKUP_BITS_VIEW == 0u ? 0u : word / LOOKUP_BITS_VIEW * LOOKUP_ORDER_VIEW;
}
#define LOOKUP_LIGHT(walk, bit) lookup_order[lookup_order_first(walk.base) + bit]
#include "lookup/parts/walk_bits.glsl"

void lookup_prepare() {}

uint lookup_tile(uint view, uvec2 pixel) {
  const uvec2 tile = pixel / LOOKUP_TILE_PX;
  return tile.x + squares_across(lookup_frames[view], LOOKUP_TILE_PX).x * tile.y;
}

// Beyond 2^32 cells, numbers come again; statistics alone ask for them.
uint lookup_cell(uint view, uvec2 pixel, float z_view) {
  const uvec2 tiles = squares_across(lookup_frames[view], LOOKUP_TILE_PX);
  return lookup_tile(view, pixel) + tiles.x * tiles.y * slice_of(z_view);
}

// Least and greatest rank.
uvec2 lookup_bin(uint view, float z_view) {
  const uint bin = slice_of(z_view);
  const uint first = view * LOOKUP_BINS_VIEW;
  if (LOOKUP_WIDE) return uvec2(lookup_bins[first + 2u * bin], lookup_bins[first + 2u * bin + 1u]);
  const uint both = lookup_bins[first + bin];
  return uvec2(both & 0xffffu, both >> 16);
}

Walk walk_begin(uint view, uvec2 pixel, float z_view) {
  const uvec2 ranks = lookup_bin(view, z_view);
  if (ranks.x > ranks.y) return walk_bits(0u, 0u, 0u);
  return walk_bits(view * LOOKUP_BITS_VIEW + lookup_tile(view, pixel) * LOOKUP_WORDS, ranks.x, ranks.y + 1u);
}
#include "lookup/parts/of_view.glsl"
