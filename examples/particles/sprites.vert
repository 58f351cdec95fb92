// A square for each particle, which faces the camera.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "particle.glsl"

layout(set = 0, binding = 1, scalar) readonly buffer ParticleBuffer { Particle particles[]; };
layout(set = 0, binding = 2, scalar) readonly buffer ScatteredBuffer { vec4 scattered[]; };
layout(push_constant, scalar) uniform Push {
  mat4 clip_from_world;
  vec2 clip_from_m;  // x and y, of a metre in the view
};
layout(location = 0) out vec2 corner;
layout(location = 1) flat out vec3 light;
layout(location = 2) flat out float opacity;

void main() {
  const vec2 corners[6] = vec2[](vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, -1), vec2(1, 1), vec2(-1, 1));
  const Particle particle = particles[gl_InstanceIndex];
  corner = corners[gl_VertexIndex];
  light = scattered[gl_InstanceIndex].xyz;
  light /= 1.0 + max(light.x, max(light.y, light.z));  // what is close to a light would be white
  opacity = particle.opacity;
  gl_Position = clip_from_world * vec4(particle.position, 1.0);
  gl_Position.xy += particle.radius * clip_from_m * corner;
}
