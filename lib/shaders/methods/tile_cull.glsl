// Tiled culling of one tile by one work group, into shared memory: bounds, planes, append, sort.
// Based on: Stewart, Compute-Based Tiled Culling, GPU Pro 7 (2016), algorithm 1.1 and listings 1.1 to 1.3.
// Needs: TILE_PX, CAPACITY; `frame`, `depth_image`, `bounds`.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_TILE_CULL
#define LAMP_METHODS_TILE_CULL
#include "common/frame.glsl"
#include "common/tile_depth.glsl"
#include "common/volume_tests.glsl"

shared uint s_light_count;  // lights found, more than CAPACITY when the list did not fit
shared uint s_lights[CAPACITY];

void compare_exchange(uint low, uint high) {
  if (high >= min(s_light_count, CAPACITY)) return;  // beyond the list stands an imaginary infinity
  const uint a = s_lights[low];
  const uint b = s_lights[high];
  if (a > b) {
    s_lights[low] = b;
    s_lights[high] = a;
  }
}

// Batcher's bitonic sort in the form whose comparators all point the same way, so that any length works.
void sort_lights() {
  const uint threads = gl_WorkGroupSize.x * gl_WorkGroupSize.y;
  const uint n = min(s_light_count, CAPACITY);
  for (uint run = 2u; run < 2u * n; run *= 2u) {
    for (uint step = run / 2u; step > 0u; step /= 2u) {
      for (uint i = gl_LocalInvocationIndex; 2u * i < n + run; i += threads) {
        const uint low = (i / step) * 2u * step + i % step;
        const uint high = step == run / 2u ? (low ^ (run - 1u)) : low + step;
        compare_exchange(low, high);
      }
      barrier();  // one step's exchanges before the next step reads
    }
  }
}

// For all threads of the group together; afterwards s_lights holds min(s_light_count, CAPACITY) ascending lights.
void cull_tile(uvec2 tile) {
  const uint threads = gl_WorkGroupSize.x * gl_WorkGroupSize.y;
  if (gl_LocalInvocationIndex == 0u) s_light_count = 0u;
  const TileDepth depth = tile_depth(frame, depth_image, tile);  // its barriers order the counter too
  if (is_empty(depth)) return;
  const float z_near = z_view_of(frame, depth.nearest);
  const float z_far = z_view_of(frame, depth.farthest);
  vec4 planes[4];
  side_planes(frame, vec2(tile * TILE_PX), vec2((tile + 1u) * TILE_PX), planes);

  for (uint light = gl_LocalInvocationIndex; light < frame.light_count; light += threads) {
    const LightBounds sphere = bounds[light];
    if (!sphere_touches_depths(sphere, z_near, z_far) || !sphere_touches_sides(sphere, planes)) continue;
    const uint place = atomicAdd(s_light_count, 1u);
    if (place < CAPACITY) s_lights[place] = light;
  }
  barrier();  // the list before it is sorted
  if (s_light_count <= CAPACITY) sort_lights();
}

#endif
