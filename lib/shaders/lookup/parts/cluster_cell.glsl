// The cluster of a pixel: tile and depth slice.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/shared/frame.h"

layout(constant_id = 100) const uint LOOKUP_TILE_PX = 64;
layout(constant_id = 101) const uint LOOKUP_SLICES = 24;
layout(constant_id = 102) const uint LOOKUP_SLICE_SCALE = 0;
layout(constant_id = 103) const uint LOOKUP_NEAR_MM = 500;
layout(constant_id = 104) const uint LOOKUP_FAR_M = 500;
layout(set = 0, binding = 16, scalar) readonly buffer LookupFrame { Frame lookup_frame; };

#define SLICES LOOKUP_SLICES
#define SLICE_SCALE LOOKUP_SLICE_SCALE
#define NEAR_MM LOOKUP_NEAR_MM
#define FAR_M LOOKUP_FAR_M
#include "common/slices.glsl"
#undef SLICES
#undef SLICE_SCALE
#undef NEAR_MM
#undef FAR_M

void lookup_prepare() {}

uint lookup_cell(uvec2 pixel, float z_view) {
  const uvec2 tile = pixel / LOOKUP_TILE_PX;
  const uvec2 tiles = (lookup_frame.size_px + LOOKUP_TILE_PX - 1u) / LOOKUP_TILE_PX;
  return tile.x + tiles.x * (tile.y + tiles.y * slice_of(z_view));
}
