// to[i] = from[i] + ADD, one thread a word.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint ADD = 0;
layout(set = 0, binding = 0, scalar) readonly buffer FromBuffer { uint from[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer ToBuffer { uint to[]; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i < to.length()) to[i] = from[i] + ADD;
}
