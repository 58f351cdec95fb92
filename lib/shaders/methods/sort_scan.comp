// Radix sort of lights, second pass: one work group a digit turns the blocks' counts into places.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "common/sort_key.glsl"

layout(local_size_x_id = 0) in;
layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) buffer CountBuffer { uint counts[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer TotalBuffer { uint totals[]; };  // a digit
#include "common/group_scan.glsl"

void main() {
  const uint blocks = sort_blocks(frame);
  const uint row = gl_WorkGroupID.x * blocks;
  uint before = 0u;
  for (uint first = 0u; first < blocks; first += gl_WorkGroupSize.x) {
    const uint block = first + gl_LocalInvocationIndex;
    uint total;
    const uint place = group_scan(block < blocks ? counts[row + block] : 0u, total);
    if (block < blocks) counts[row + block] = before + place;
    before += total;
  }
  if (gl_LocalInvocationIndex == 0u) totals[gl_WorkGroupID.x] = before;
}
