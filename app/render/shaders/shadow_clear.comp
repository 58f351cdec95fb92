// Clears the squares of shadow maps that are about to be rasterized in compute: nothing drawn, infinitely far away.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shadow_data.h"

layout(local_size_x = 16, local_size_y = 16) in;
layout(set = 0, binding = 0, scalar) readonly buffer SquareBuffer { ShadowSquare squares[]; };
layout(set = 0, binding = 1, r32ui) uniform writeonly uimage2D atlas;
layout(push_constant) uniform Push { uint count; };

void main() {
  for (uint i = gl_WorkGroupID.y; i < count; i += gl_NumWorkGroups.y) {
    const uint blocks = squares[i].side / gl_WorkGroupSize.x;
    for (uint b = gl_WorkGroupID.x; b < blocks * blocks; b += gl_NumWorkGroups.x) {
      const uvec2 block = uvec2(b % blocks, b / blocks);
      imageStore(atlas, ivec2(squares[i].corner + block * gl_WorkGroupSize.xy + gl_LocalInvocationID.xy), uvec4(0u));
    }
  }
}
