// The cluster of a pixel: tile and depth slice.
// SPDX-License-Identifier: Apache-2.0
#include "lookup/parts/resources.glsl"

LOOKUP_CONSTANT(0, uint, LOOKUP_TILE_PX, 64);

#define LOOKUP_SLICE_CONSTANT 1
#include "lookup/parts/slice_constants.glsl"

void lookup_prepare() {}

uint lookup_cell(uint view, uvec2 pixel, float z_view) {
  const uvec2 tile = pixel / LOOKUP_TILE_PX;
  const uvec2 tiles = squares_across(lookup_frames[view], LOOKUP_TILE_PX);
  return tile.x + tiles.x * (tile.y + tiles.y * slice_of(z_view));
}
