// One work group a tile: cull, one bit a light. Groups of lights as large as the work group fill their words in
// shared memory, then a few threads write them.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lamplight/shared/frame.h"
#include "lamplight/shared/light.h"

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint TILE_PX = 16;
layout(constant_id = 2) const uint WORDS = 1;  // words a tile: light capacity / 32, rounded up
layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frame; };
layout(set = 0, binding = 1) uniform texture2D depth_image;
layout(set = 0, binding = 2, scalar) readonly buffer BoundsBuffer { LightBounds bounds[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer BitBuffer { uint bits[]; };

#include "common/tile_depth.glsl"
#include "common/volume_tests.glsl"

shared uint s_words[8];  // 256 threads at most, 32 lights a word

void main() {
  const uvec2 tile = gl_WorkGroupID.xy;
  const uint thread = gl_LocalInvocationIndex;
  const uint threads = gl_WorkGroupSize.x;
  const uint base = (tile.x + gl_NumWorkGroups.x * tile.y) * WORDS;

  const TileDepth depth = tile_depth(frame, depth_image, tile);
  const float z_near = z_view_of(frame, depth.nearest);
  const float z_far = z_view_of(frame, depth.farthest);
  vec4 planes[4];
  side_planes(frame, vec2(tile * TILE_PX), vec2((tile + 1u) * TILE_PX), planes);

  for (uint first = 0u; first < frame.light_count; first += threads) {
    if (thread < threads / 32u) s_words[thread] = 0u;
    barrier();  // cleared words before bits are set
    const uint light = first + thread;
    if (light < frame.light_count && !is_empty(depth)) {
      const LightBounds sphere = bounds[light];
      if (sphere_touches_depths(sphere, z_near, z_far) && sphere_touches_sides(sphere, planes))
        atomicOr(s_words[thread / 32u], 1u << (thread % 32u));
    }
    barrier();  // all bits before the words are written
    if (thread < threads / 32u && first / 32u + thread < WORDS) bits[base + first / 32u + thread] = s_words[thread];
    barrier();  // words written before they are cleared again
  }
}
