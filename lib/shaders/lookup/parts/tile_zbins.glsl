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

#define LOOKUP_SLICE_CONSTANT 2
#include "lookup/parts/slice_constants.glsl"

#define LOOKUP_LIGHT(bit) lookup_order[bit]
#include "lookup/parts/walk_bits.glsl"

void lookup_prepare() {}

uint lookup_tile(uvec2 pixel) {
  const uvec2 tile = pixel / LOOKUP_TILE_PX;
  return tile.x + (lookup_frame.size_px.x + LOOKUP_TILE_PX - 1u) / LOOKUP_TILE_PX * tile.y;
}

// Beyond 2^32 cells, numbers come again; statistics alone ask for them.
uint lookup_cell(uvec2 pixel, float z_view) {
  const uvec2 tiles = (lookup_frame.size_px + LOOKUP_TILE_PX - 1u) / LOOKUP_TILE_PX;
  return lookup_tile(pixel) + tiles.x * tiles.y * slice_of(z_view);
}

// Least and greatest rank.
uvec2 lookup_bin(float z_view) {
  const uint bin = slice_of(z_view);
  if (LOOKUP_WIDE) return uvec2(lookup_bins[2u * bin], lookup_bins[2u * bin + 1u]);
  const uint both = lookup_bins[bin];
  return uvec2(both & 0xffffu, both >> 16);
}

Walk walk_begin(uvec2 pixel, float z_view) {
  const uvec2 ranks = lookup_bin(z_view);
  if (ranks.x > ranks.y) return walk_bits(0u, 0u, 0u);
  return walk_bits(lookup_tile(pixel) * LOOKUP_WORDS, ranks.x, ranks.y + 1u);
}
