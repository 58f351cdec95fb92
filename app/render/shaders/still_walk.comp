// Walks triangle lists at many points: how many lights each names, and a hash of them in their order.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "still_data.h"
#include "world/triangle_lists.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer PointBuffer { StillPoint points[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer WalkBuffer { StillWalk walks[]; };
layout(push_constant) uniform Push { uint point_count; };

void main() {
  const uint point = gl_GlobalInvocationID.x;
  if (point >= point_count) return;
  StillWalk met = StillWalk(0u, STILL_HASH_FIRST);
  uint light;
  for (TriangleWalk walk = triangle_walk_begin(points[point].triangle, points[point].position);
       triangle_walk_next(walk, light);) {
    ++met.lights;
    met.hash = (met.hash ^ light) * STILL_HASH_TIMES;
  }
  walks[point] = met;
}
