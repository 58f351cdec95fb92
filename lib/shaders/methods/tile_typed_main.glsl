// One work group a tile: cull, then write its lights into one shared list, points first, then spots.
// Based on: Primal engine, Light Culling with Approximate Sphere-Cone Intersection, listing 9: one offset and two 16-bit
// counts a tile, one global counter. The sort puts points first (TYPE_BIT), so the counts follow from one search.
// SPDX-License-Identifier: Apache-2.0
layout(local_size_x_id = 0) in;  // before anything that asks for the work group's size
#define TILE_CONSTANT 1
#define TILE_BINDING 0
#define TILE_FRAME uniform
#include "lamplight/shared/counters.h"
#include "methods/tile_cull.glsl"

layout(constant_id = 14) const uint ENTRIES = 1;  // of the shared list
layout(set = 0, binding = 7, scalar) writeonly buffer ListBuffer { uint lists[]; };
layout(set = 0, binding = 8, scalar) writeonly buffer SplitBuffer { float splits[]; };   // a tile
layout(set = 0, binding = 9, scalar) buffer CounterBuffer { Counters counters; };
layout(set = 0, binding = 10, scalar) writeonly buffer HeaderBuffer { uvec2 headers[]; };  // offset, points | spots << 16
#include "methods/tile_overflow.glsl"

const uint OVERFLOWED = ~0u;
shared uint s_offset;

uint count_points(uint range) {
  uint low = 0u;
  uint high = s_light_count[range];
  while (low < high) {
    const uint middle = (low + high) / 2u;
    if ((s_lights[range * CAPACITY + middle] & TYPE_BIT) != 0u)
      high = middle;
    else
      low = middle + 1u;
  }
  return low;
}

// Takes a part of the shared list, or counts that there is none.
uint take_entries(uint range) {
  if (!list_fits(range)) {
    count_overflow(range);
    return OVERFLOWED;
  }
  const uint count = s_light_count[range];
  const uint offset = atomicAdd(counters.entries_needed, count);
  if (offset <= ENTRIES && count <= ENTRIES - offset) return offset;
  atomicAdd(counters.overflowed_cells, 1u);
  return OVERFLOWED;
}

// By thread 0.
void write_header(uint cell, uint range) {
  s_offset = take_entries(range);
  const uint points = s_offset == OVERFLOWED ? 0u : count_points(range);
  const uint spots = s_offset == OVERFLOWED ? 0u : s_light_count[range] - points;
  headers[cell] = uvec2(s_offset, points | spots << 16);
}

void main() {
  const TileRanges ranges = cull_tile(gl_WorkGroupID.xy);
  const uint tile = tile_index(gl_WorkGroupID.xy);
  if (gl_LocalInvocationIndex == 0u) splits[tile] = ranges.split;
  for (uint range = 0u; range < RANGES; ++range) {
    barrier();  // the last range's offset is read before it changes
    if (gl_LocalInvocationIndex == 0u) write_header(tile * RANGES + range, range);
    barrier();  // the offset before it is used
    if (s_offset == OVERFLOWED) continue;
    for (uint i = gl_LocalInvocationIndex; i < s_light_count[range]; i += gl_WorkGroupSize.x)
      lists[s_offset + i] = s_lights[range * CAPACITY + i] & ~TYPE_BIT;
  }
}
