// Lights particles: each walks the lights of its position, in the picture or not.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lookup/world_cells.glsl"  // lamplight
#include "scatter.glsl"

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= particles.length()) return;
  const vec3 position = particles[i].position;
  vec4 sum = vec4(0.0);
  uint light;
  for (Walk walk = world_walk_begin(position); world_walk_next(walk, light);)  // lamplight
    sum += vec4(scattered_from(lights[light], position), 1.0);
  scattered[i] = sum;
}
