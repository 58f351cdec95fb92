// One work group a tile: cull, then write its lights into one shared list, points first, then spots.
// Based on: Primal engine, Light Culling with Approximate Sphere-Cone Intersection, listing 9: one offset and two 16-bit
// counts a tile, one global counter. The sort puts points first (TYPE_BIT), so the counts follow from one search.
// SPDX-License-Identifier: Apache-2.0
layout(local_size_x_id = 0) in;  // before anything that asks for the work group's size
#define TILE_CONSTANT 1
#define TILE_BINDING 0
#include "lamplight/shared/counters.h"
#include "methods/tile_cull.glsl"

layout(constant_id = 13) const uint ENTRIES = 1;  // of the shared list
layout(set = 0, binding = 6, scalar) writeonly buffer ListBuffer { uint lists[]; };
layout(set = 0, binding = 7, scalar) writeonly buffer SplitBuffer { float splits[]; };   // a tile
layout(set = 0, binding = 8, scalar) buffer CounterBuffer { Counters counters; };
layout(set = 0, binding = 9, scalar) writeonly buffer HeaderBuffer { uvec2 headers[]; };  // offset, points | spots << 16

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

// Thread 0: takes a part of the shared list and writes the header.
void allocate(uint cell, uint range) {
  const uint count = s_light_count[range];
  s_offset = list_fits(range) ? atomicAdd(counters.entries_needed, count) : OVERFLOWED;
  if (!list_fits(range)) atomicMax(counters.longest_list, count);
  if (s_offset > ENTRIES || count > ENTRIES - s_offset) s_offset = OVERFLOWED;
  if (s_offset == OVERFLOWED) {
    atomicAdd(counters.overflowed_cells, 1u);
    headers[cell] = uvec2(OVERFLOWED, 0u);
    return;
  }
  const uint points = count_points(range);
  headers[cell] = uvec2(s_offset, points | (count - points) << 16);
}

void main() {
  const TileRanges ranges = cull_tile(gl_WorkGroupID.xy);
  const uint tile = tile_index(gl_WorkGroupID.xy);
  if (gl_LocalInvocationIndex == 0u) splits[tile] = ranges.split;
  for (uint range = 0u; range < RANGES; ++range) {
    barrier();  // the last range's offset is read before it changes
    if (gl_LocalInvocationIndex == 0u) allocate(tile * RANGES + range, range);
    barrier();  // the offset before it is used
    if (s_offset == OVERFLOWED) continue;
    for (uint i = gl_LocalInvocationIndex; i < s_light_count[range]; i += gl_WorkGroupSize.x)
      lists[s_offset + i] = s_lights[range * CAPACITY + i] & ~TYPE_BIT;
  }
}
