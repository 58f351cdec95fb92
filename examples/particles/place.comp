// Where the particles are in this frame: in plumes that turn as they rise, widen and thin out.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "particle.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 1, scalar) writeonly buffer ParticleBuffer { Particle particles[]; };
const uint PLUMES = 8u;
layout(push_constant, scalar) uniform Push {
  vec3 plumes[PLUMES];  // where they rise from
  float time;           // in lives of a particle
};

// 0 .. 1. PCG: Jarzynski, Olano, Hash Functions for GPU Rendering (2020).
float random(inout uint state) {
  state = state * 747796405u + 2891336453u;
  const uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return float((word >> 22u) ^ word) / 4294967296.0;
}

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= particles.length()) return;
  uint state = i * 9781u + 1u;
  const float age = fract(random(state) + time);
  const float angle = 6.2832 * (random(state) + 0.6 * age);
  const float off_axis = (0.3 + 1.3 * age) * sqrt(random(state));
  const float sway = 0.7 * age * sin(5.0 * age - 6.2832 * time);
  const vec3 offset = vec3(off_axis * cos(angle) + sway, 3.4 * age + 0.4 * random(state), off_axis * sin(angle));
  particles[i] = Particle(plumes[i % PLUMES] + offset, 0.15 + 0.4 * age, 0.35 * (1.0 - age));
}
