// One thread a light in the order of depth: its bounds, so that tiles read them one after the other.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "common/frame.glsl"
#include "lamplight/shared/light.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) readonly buffer BoundsBuffer { LightBounds bounds[]; };
layout(set = 0, binding = 2, scalar) readonly buffer OrderBuffer { uint order[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer SortedBuffer { LightBounds sorted[]; };

void main() {
  const uint rank = gl_GlobalInvocationID.x;
  if (rank < light_count_of(frame)) sorted[rank] = bounds[order[rank]];
}
