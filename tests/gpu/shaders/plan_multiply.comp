// words[i] *= FACTOR, one thread a word.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint FACTOR = 1;
layout(set = 0, binding = 0, scalar) buffer WordBuffer { uint words[]; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i < words.length()) words[i] *= FACTOR;
}
