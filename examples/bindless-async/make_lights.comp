// Lights made on the GPU: particles on their way, of which only those that are alive this frame become lights.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lighting.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 2, scalar) buffer CountBuffer { uint light_count; };
layout(set = 0, binding = 1, scalar) writeonly buffer LightBuffer { HostLight lights[]; };
layout(push_constant) uniform Push {
  uint particle_count;
  uint frame;
};

// 0 .. 1. PCG: Jarzynski, Olano, Hash Functions for GPU Rendering (2020).
float random(inout uint state) {
  state = state * 747796405u + 2891336453u;
  const uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return float((word >> 22u) ^ word) / 4294967296.0;
}

void main() {
  const uint particle = gl_GlobalInvocationID.x;
  if (particle >= particle_count || (particle + frame) % 3u == 0u) return;  // a third is not alive
  uint state = particle * 9781u + 1u;
  HostLight light;
  const float angle = 6.2832 * random(state) + 0.3 * float(frame);
  const float radius = 14.0 * sqrt(random(state));
  light.position = vec3(radius * cos(angle), 0.3 + 2.2 * random(state), radius * sin(angle));
  light.range = 1.0 + 1.5 * random(state);
  light.direction = vec3(0.0);
  light.outer_angle = -1.0;
  light.color = vec3(random(state), random(state), random(state)) * light.range;
  light.reserved = 0.0;
  lights[atomicAdd(light_count, 1u)] = light;
}
