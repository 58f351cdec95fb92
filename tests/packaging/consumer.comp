// The smallest shader that includes a look-up: how many lights each pixel walks at one metre.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lookup/cluster_lists.glsl"
#include "lamplight/shared/light.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, scalar) writeonly buffer CountBuffer { uint counts[]; };

void main() {
  const uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, lookup_frame.size_px))) return;
  uint count = 0u;
  uint light;
  for (Walk walk = walk_begin(pixel, 1.0); walk_next(walk, light);) count += 1u;
  counts[pixel.x + lookup_frame.size_px.x * pixel.y] = count;
}
