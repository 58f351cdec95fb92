// What both shaders that light particles have in common: a particle a thread, and the lights. Smoke scatters light alike
// to all sides.
// SPDX-License-Identifier: Apache-2.0
#include "lighting.glsl"
#include "particle.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 1, scalar) readonly buffer LightBuffer { HostLight lights[]; };
layout(set = 0, binding = 2, scalar) readonly buffer ParticleBuffer { Particle particles[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer ScatteredBuffer { vec4 scattered[]; };  // w: lights that were walked

vec3 scattered_from(HostLight light, vec3 position) {
  vec3 to_light;
  return light_at(light, position, to_light);
}
