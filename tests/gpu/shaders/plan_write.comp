// words[i] = VALUE for every EVERY-th word.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint VALUE = 0;
layout(constant_id = 1) const uint EVERY = 1;
layout(set = 0, binding = 0, scalar) writeonly buffer WordBuffer { uint words[]; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i < words.length() && i % EVERY == 0u) words[i] = VALUE;
}
