// Look-up for compute shaders that cull and shade in one dispatch: the group culls its tile, the walk reads shared memory.
// Based on: Stewart, Compute-Based Tiled Culling, GPU Pro 7 (2016), 1.3.3 (tiled deferred).
// Promise: the work group must be one tile, TILE_PX x TILE_PX threads, pixel = gl_GlobalInvocationID.xy.
// SPDX-License-Identifier: Apache-2.0
#define TILE_CONSTANT 100
#define TILE_BINDING 16
#define TILE_FRAME readonly buffer
#ifndef LOOKUP_VIEW
#define LOOKUP_VIEW 0u
#endif
#include "lamplight/shared/counters.h"
#include "methods/tile_cull.glsl"

layout(set = 0, binding = TILE_BINDING + 7, scalar) buffer CounterBuffer { Counters counters; };
#include "methods/tile_overflow.glsl"

#include "lookup/parts/list_walk.glsl"

TileRanges lookup_ranges;

void lookup_prepare() {
  lookup_ranges = cull_tile(gl_WorkGroupID.xy);
  if (gl_LocalInvocationIndex != 0u) return;
  for (uint range = 0u; range < RANGES; ++range)
    if (!list_fits(range)) count_overflow(range);
}

uint lookup_range(float z_view) { return RANGES == 2u && z_view > lookup_ranges.split ? 1u : 0u; }

// A group's own tile, so the view is that of the pass.
uint lookup_cell(uint view, uvec2 pixel, float z_view) {
  return (gl_WorkGroupID.x + gl_NumWorkGroups.x * gl_WorkGroupID.y) * RANGES + lookup_range(z_view);
}

Walk walk_begin(uint view, uvec2 pixel, float z_view) {
  const uint range = lookup_range(z_view);
  if (!list_fits(range)) return walk_from(0u, light_count_of(cull_frame), true);
  return walk_from(range * CAPACITY, range * CAPACITY + s_light_count[range], false);
}
#include "lookup/parts/of_view.glsl"

uint lookup_light_at(Walk walk, uint place) { return walk.overflowed ? place : s_lights[place] & ~TYPE_BIT; }

#include "lookup/parts/walk_places.glsl"
