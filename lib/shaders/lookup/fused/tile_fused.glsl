// Look-up for compute shaders that cull and shade in one dispatch: the group culls its tile, the walk reads shared memory.
// Based on: Stewart, Compute-Based Tiled Culling, GPU Pro 7 (2016), 1.3.3 (tiled deferred).
// Promise: the work group must be one tile, TILE_PX x TILE_PX threads, pixel = gl_GlobalInvocationID.xy.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/shared/frame.h"
#include "lamplight/shared/light.h"

layout(constant_id = 100) const uint TILE_PX = 16;
layout(constant_id = 101) const uint CAPACITY = 512;
layout(set = 0, binding = 16, scalar) readonly buffer LookupFrame { Frame lookup_frame; };
layout(set = 0, binding = 17) uniform texture2D lookup_depth;
layout(set = 0, binding = 18, scalar) readonly buffer LookupBounds { LightBounds lookup_bounds[]; };

#define frame lookup_frame
#define depth_image lookup_depth
#define bounds lookup_bounds
#include "methods/tile_cull.glsl"
#undef frame
#undef depth_image
#undef bounds

struct Walk {
  uint at;
  uint end;
  bool overflowed;
};

void lookup_prepare() { cull_tile(gl_WorkGroupID.xy); }

uint lookup_cell(uvec2 pixel, float z_view) { return gl_WorkGroupID.x + gl_NumWorkGroups.x * gl_WorkGroupID.y; }

Walk walk_begin(uvec2 pixel, float z_view) {
  if (s_light_count > CAPACITY) return Walk(0u, lookup_frame.light_count, true);
  return Walk(0u, s_light_count, false);
}

bool walk_next(inout Walk walk, out uint light) {
  if (walk.at >= walk.end) return false;
  light = walk.overflowed ? walk.at : s_lights[walk.at];
  ++walk.at;
  return true;
}
