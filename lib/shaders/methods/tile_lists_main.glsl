// One work group a tile: cull, then write the tile's lists, each in a place of its own.
// SPDX-License-Identifier: Apache-2.0
layout(local_size_x_id = 0) in;  // before anything that asks for the work group's size
#define TILE_CONSTANT 1
#define TILE_BINDING 0
#define TILE_FRAME uniform
#include "lamplight/shared/counters.h"
#include "methods/tile_cull.glsl"

layout(set = 0, binding = 7, scalar) writeonly buffer ListBuffer { uint lists[]; };    // count, then lights, a cell
layout(set = 0, binding = 8, scalar) writeonly buffer SplitBuffer { float splits[]; };  // a tile
layout(set = 0, binding = 9, scalar) buffer CounterBuffer { Counters counters; };
#include "methods/tile_overflow.glsl"

void main() {
  const TileRanges ranges = cull_tile(gl_WorkGroupID.xy);
  const uint tile = tile_index(gl_WorkGroupID.xy);
  if (gl_LocalInvocationIndex == 0u) splits[tile] = ranges.split;
  for (uint range = 0u; range < RANGES; ++range) {
    const uint base = (tile * RANGES + range) * (1u + CAPACITY);
    if (gl_LocalInvocationIndex == 0u) {
      lists[base] = s_light_count[range];
      if (!list_fits(range)) count_overflow(range);
    }
    if (!list_fits(range)) continue;
    for (uint i = gl_LocalInvocationIndex; i < s_light_count[range]; i += gl_WorkGroupSize.x)
      lists[base + 1u + i] = s_lights[range * CAPACITY + i];
  }
}
