// One work group a tile: cull into flat bit arrays, one a depth range. Lights come in batches as large as the group;
// a batch's words are gathered (and pruned) in shared memory, then a few threads write them.
// Based on: Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017), for the container.
// SPDX-License-Identifier: Apache-2.0
layout(local_size_x_id = 0) in;  // before anything that asks for the work group's size
#define TILE_CONSTANT 1
#define TILE_BINDING 0
#define TILE_FRAME uniform
#include "common/atomic_load.glsl"
#include "methods/tile_inputs.glsl"
#include "common/pixel_tests.glsl"

layout(constant_id = 14) const uint WORDS = 1;  // words a cell: light capacity / 32, rounded up
layout(set = 0, binding = 7, scalar) writeonly buffer BitBuffer { uint bits[]; };
layout(set = 0, binding = 8, scalar) writeonly buffer SplitBuffer { float splits[]; };  // a tile

const uint BATCH_WORDS = 8u;  // 256 threads at most, 32 lights a word
shared uint s_found[2u * BATCH_WORDS];
shared uint s_kept[2u * BATCH_WORDS];

void flag_reached(PrunePixel pixel, uint range, uint first) {
  for (uint word = 0u; word < gl_WorkGroupSize.x / 32u; ++word) {
    const uint at = range * BATCH_WORDS + word;
    for (uint open = s_found[at] & ~LOAD_OF_GROUP(s_kept[at]); open != 0u; open &= open - 1u) {
      const uint bit = uint(findLSB(open));
      const uint light = first + word * 32u + bit;
      if (reaches_pixel(cull_frame, light, cull_lights[light], pixel)) atomicOr(s_kept[at], 1u << bit);
    }
  }
}

void prune_batch(uvec2 tile, TileRanges ranges, uint first) {
  for (uint i = gl_LocalInvocationIndex; i < tile_samples(cull_depth); i += gl_WorkGroupSize.x) {
    const PrunePixel pixel = prune_pixel(cull_frame, cull_depth, tile, i);
    if (pixel.covered) flag_reached(pixel, range_of_depth(pixel.z_view, ranges), first);
  }
}

void find_batch(uint light, TileTarget target) {
  const LightBounds sphere = bounds_of(light);
  if (!touches_any_range(sphere, target)) return;
  for (uint range = 0u; range < RANGES; ++range)
    if (touches_range(light, sphere, target, range))
      atomicOr(s_found[range * BATCH_WORDS + gl_LocalInvocationIndex / 32u], 1u << (gl_LocalInvocationIndex % 32u));
}

void main() {
  const uint thread = gl_LocalInvocationIndex;
  const uint threads = gl_WorkGroupSize.x;
  const uint tile = tile_index(gl_WorkGroupID.xy);
  const TileRanges ranges = ranges_of(gl_WorkGroupID.xy);
  const TileTarget target = tile_target(gl_WorkGroupID.xy, ranges);
  if (thread == 0u) splits[tile] = ranges.split;

  for (uint first = 0u; first < light_count_of(cull_frame); first += threads) {
    if (thread < RANGES * BATCH_WORDS) {
      s_found[thread] = 0u;
      s_kept[thread] = 0u;
    }
    barrier();  // cleared words before bits are set
    if (first + thread < light_count_of(cull_frame) && !is_empty(ranges)) find_batch(first + thread, target);
    barrier();  // all found before they are pruned or written
    if (PRUNE) prune_batch(gl_WorkGroupID.xy, ranges, first);
    barrier();  // all kept before the words are written
    const uint word = thread % BATCH_WORDS;
    const uint range = thread / BATCH_WORDS;
    if (range < RANGES && word < threads / 32u && first / 32u + word < WORDS)
      bits[(tile * RANGES + range) * WORDS + first / 32u + word] = PRUNE ? s_kept[thread] : s_found[thread];
    barrier();  // words written before they are cleared again
  }
}
