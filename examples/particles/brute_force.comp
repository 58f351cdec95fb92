// The particles' light from all lights, to compare with.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "scatter.glsl"

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= particles.length()) return;
  const vec3 position = particles[i].position;
  vec4 sum = vec4(0.0);
  for (uint light = 0u; light < lights.length(); ++light) sum += vec4(scattered_from(lights[light], position), 1.0);
  scattered[i] = sum;
}
