// Look-up: clusters (tile and depth slice), each a range of one shared list; a range beyond its end means every light.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/shared/frame.h"

layout(constant_id = 100) const uint LOOKUP_TILE_PX = 64;
layout(constant_id = 101) const uint LOOKUP_SLICES = 24;
layout(constant_id = 102) const uint LOOKUP_NEAR_MM = 500;
layout(constant_id = 103) const uint LOOKUP_FAR_M = 500;
layout(constant_id = 104) const uint LOOKUP_ENTRIES = 1;
layout(constant_id = 105) const uint LOOKUP_SLICE_SCALE = 0;
layout(set = 0, binding = 16, scalar) readonly buffer LookupFrame { Frame lookup_frame; };
layout(set = 0, binding = 17, scalar) readonly buffer LookupRanges { uvec2 lookup_ranges[]; };
layout(set = 0, binding = 18, scalar) readonly buffer LookupLists { uint lookup_lists[]; };

#define SLICES LOOKUP_SLICES
#define SLICE_SCALE LOOKUP_SLICE_SCALE
#define NEAR_MM LOOKUP_NEAR_MM
#define FAR_M LOOKUP_FAR_M
#include "common/slices.glsl"
#undef SLICES
#undef SLICE_SCALE
#undef NEAR_MM
#undef FAR_M

struct Walk {
  uint at;
  uint end;
  bool overflowed;
};

void lookup_prepare() {}

uint lookup_cell(uvec2 pixel, float z_view) {
  const uvec2 tile = pixel / LOOKUP_TILE_PX;
  const uvec2 tiles = (lookup_frame.size_px + LOOKUP_TILE_PX - 1u) / LOOKUP_TILE_PX;
  return tile.x + tiles.x * (tile.y + tiles.y * slice_of(z_view));
}

Walk walk_begin(uvec2 pixel, float z_view) {
  const uvec2 range = lookup_ranges[lookup_cell(pixel, z_view)];
  if (range.x > LOOKUP_ENTRIES || range.y > LOOKUP_ENTRIES - range.x) return Walk(0u, lookup_frame.light_count, true);
  return Walk(range.x, range.x + range.y, false);
}

bool walk_next(inout Walk walk, out uint light) {
  if (walk.at >= walk.end) return false;
  light = walk.overflowed ? walk.at : lookup_lists[walk.at];
  ++walk.at;
  return true;
}
