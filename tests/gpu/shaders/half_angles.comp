// One thread an angle: its sine and cosine.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "common/angles.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer AngleBuffer { float angles[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer AnswerBuffer { vec2 answers[]; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i < uint(angles.length())) answers[i] = vec2(sine_of(angles[i]), cosine_of(angles[i]));
}
