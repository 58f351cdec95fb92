// Culls one tile by one work group into shared memory: ranges, test, append, prune, sort. One list a depth range.
// Based on: Stewart, Compute-Based Tiled Culling, GPU Pro 7 (2016), algorithm 1.1 and listings 1.1 to 1.4; Primal engine,
// Light Culling with Approximate Sphere-Cone Intersection, listing 9.
// Promise: afterwards list r holds min(s_light_count[r], CAPACITY) lights; a larger count means that it did not fit.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_TILE_CULL
#define LAMP_METHODS_TILE_CULL
#include "common/atomic_load.glsl"
#include "methods/tile_inputs.glsl"
#include "common/pixel_tests.glsl"

// Array sizes are plain constants: expressions of specialization constants are not safe as sizes everywhere.
shared uint s_light_count[2];
shared uint s_lights[LIST_ENTRIES];
#define SORT_KEYS s_lights
#include "common/sort.glsl"
shared uint s_kept[128];  // one bit an entry, for up to 2 x 2048: a pixel is reached by it

uint group_threads() { return gl_WorkGroupSize.x * gl_WorkGroupSize.y; }

bool list_fits(uint range) { return s_light_count[range] <= CAPACITY; }

void append_light(uint range, uint light) {
  const uint place = atomicAdd(s_light_count[range], 1u);
  if (place >= CAPACITY) return;
  const bool by_type = ORDER == ORDER_TYPE && cull_lights[light].type == LIGHT_SPOT;
  s_lights[range * CAPACITY + place] = by_type ? light | TYPE_BIT : light;
}

// Flags the entries of the pixel's range that reach it.
void flag_reached(PrunePixel pixel, uint range) {
  if (!pixel.covered || !list_fits(range)) return;
  for (uint i = 0u; i < s_light_count[range]; ++i) {
    const uint entry = range * CAPACITY + i;
    const uint bit = 1u << (entry % 32u);
    if ((LOAD_OF_GROUP(s_kept[entry / 32u]) & bit) != 0u) continue;
    const uint light = s_lights[entry] & ~TYPE_BIT;
    if (reaches_pixel(cull_frame, light, cull_lights[light], pixel)) atomicOr(s_kept[entry / 32u], bit);
  }
}

uint kept_before(uint range, uint entry) {
  const uint first = range * CAPACITY;
  uint count = 0u;
  for (uint word = first / 32u; word <= entry / 32u; ++word) {
    uint bits = s_kept[word];
    if (word == first / 32u) bits &= ~0u << (first % 32u);
    if (word == entry / 32u) bits &= (1u << (entry % 32u)) - 1u;
    count += uint(bitCount(bits));
  }
  return count;
}

// Moves the flagged entries together, in their order; a chunk moves only into places that have been read before.
void compact_kept(uint range) {
  const uint n = s_light_count[range];
  for (uint first = 0u; first < n; first += group_threads()) {
    const uint entry = range * CAPACITY + first + gl_LocalInvocationIndex;
    const bool kept =
        first + gl_LocalInvocationIndex < n && (s_kept[entry / 32u] & (1u << (entry % 32u))) != 0u;
    const uint light = kept ? s_lights[entry] : 0u;
    barrier();  // the chunk is read before any of it is overwritten
    if (kept) s_lights[range * CAPACITY + kept_before(range, entry)] = light;
    barrier();  // and written before the next chunk is read
  }
  if (gl_LocalInvocationIndex == 0u) s_light_count[range] = kept_before(range, range * CAPACITY + n);
  barrier();  // the new count before it is used
}

void prune_lights(uvec2 tile, TileRanges ranges) {
  for (uint word = gl_LocalInvocationIndex; word < (LIST_ENTRIES + 31u) / 32u; word += group_threads()) s_kept[word] = 0u;
  barrier();  // cleared before flags are set
  for (uint i = gl_LocalInvocationIndex; i < tile_samples(cull_depth); i += group_threads()) {
    const PrunePixel pixel = prune_pixel(cull_frame, cull_depth, tile, i);
    flag_reached(pixel, range_of_depth(pixel.z_view, ranges));
  }
  barrier();  // all flags before entries move
  for (uint range = 0u; range < RANGES; ++range)
    if (list_fits(range)) compact_kept(range);
}

// For all threads of the group together. Returns the ranges.
TileRanges cull_tile(uvec2 tile) {
  if (gl_LocalInvocationIndex < RANGES) s_light_count[gl_LocalInvocationIndex] = 0u;
  barrier();  // counters before the first append
  const TileRanges ranges = ranges_of(tile);
  if (is_empty(ranges)) return ranges;
  const TileTarget target = tile_target(tile, ranges);
  for (uint light = gl_LocalInvocationIndex; light < light_count_of(cull_frame); light += group_threads()) {
    const LightBounds sphere = bounds_of(light);
    if (!touches_any_range(sphere, target)) continue;
    for (uint range = 0u; range < RANGES; ++range)
      if (touches_range(light, sphere, target, range)) append_light(range, light);
  }
  barrier();  // the lists before they are pruned and sorted
  if (PRUNE) prune_lights(tile, ranges);
  for (uint range = 0u; range < RANGES; ++range)
    if (ORDER != ORDER_APPEND && list_fits(range)) sort_keys(range * CAPACITY, s_light_count[range]);
  return ranges;
}

#endif
