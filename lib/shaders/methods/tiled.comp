// One work group a tile: cull, then write the tile's list.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lamplight/shared/counters.h"
#include "lamplight/shared/frame.h"
#include "lamplight/shared/light.h"

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint TILE_PX = 16;
layout(constant_id = 2) const uint CAPACITY = 512;
layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frame; };
layout(set = 0, binding = 1) uniform texture2D depth_image;
layout(set = 0, binding = 2, scalar) readonly buffer BoundsBuffer { LightBounds bounds[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer ListBuffer { uint lists[]; };  // count, then lights, a tile
layout(set = 0, binding = 4, scalar) buffer CounterBuffer { Counters counters; };

#include "methods/tile_cull.glsl"

void main() {
  cull_tile(gl_WorkGroupID.xy);

  const uint tile = gl_WorkGroupID.x + gl_NumWorkGroups.x * gl_WorkGroupID.y;
  const uint base = tile * (1u + CAPACITY);
  if (gl_LocalInvocationIndex == 0u) {
    lists[base] = s_light_count;
    if (s_light_count > CAPACITY) atomicAdd(counters.overflowed_cells, 1u);
  }
  if (s_light_count > CAPACITY) return;
  for (uint i = gl_LocalInvocationIndex; i < s_light_count; i += gl_WorkGroupSize.x)
    lists[base + 1u + i] = s_lights[i];
}
