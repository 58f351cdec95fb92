// What both pixel shaders have in common: the surface, the lights, the look-up of shadows.
// SPDX-License-Identifier: Apache-2.0
#include "lighting.glsl"
#include "shadow/shadow.glsl"  // lamplight

layout(set = 0, binding = 1, scalar) readonly buffer LightBuffer { HostLight lights[]; };
layout(location = 0) in vec3 position;
layout(location = 1) flat in vec3 normal;
layout(location = 2) flat in uint material;
layout(location = 0) out vec4 target;  // w: lights that were walked

vec3 shadowed_light(uint light) {
  const vec3 arrives = light_on(lights[light], position, normal);
  if (arrives == vec3(0.0)) return vec3(0.0);
  // lamplight {
  const uint seed = uint(gl_FragCoord.y) * 65536u + uint(gl_FragCoord.x);  // turns the taps of the filter
  return arrives * shadow_of(light, position, normal, seed);
  // }
}
