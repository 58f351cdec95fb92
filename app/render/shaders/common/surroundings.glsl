// Light that no culling of lights concerns: ambient, directional, emitted; and what reflection probes have in place of
// the ambient light.
// Needs: `surroundings`, `directional_lights`.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_SURROUNDINGS
#define LAMP_SURROUNDINGS
#include "common/brdf.glsl"
#include "common/probe_blend.glsl"

void add_directional(inout vec3 sum, Reflector r) {
  for (uint i = 0u; i < surroundings.directional_count; ++i) {
    const vec3 to_light = -directional_lights[i].direction;
    const float n_l = fused_dot(r.normal, to_light);
    if (n_l <= 0.0) continue;
    precise const vec3 halfway = fma(to_light, vec3(0.5), r.half_eye);
    sum = fma(reflect_light(r, halfway, n_l, n_l), directional_lights[i].illuminance, sum);
  }
}

vec3 shade_surroundings(Surface s, Reflector r, vec3 emitted) {
  precise vec3 sum = fma(reflect_surroundings(r, surroundings.ambient), vec3(s.occlusion), emitted);
  add_directional(sum, r);
  return sum;
}

// Without weight of any probe it is what it is above, bit for bit.
vec3 shade_surroundings(Surface s, Reflector r, vec3 emitted, ProbeSum probes) {
  precise const float left = 1.0 - probes.weight;
  precise const vec3 reflected = reflect_surroundings(r, surroundings.ambient, left) + probes.specular;
  precise vec3 sum = fma(reflected, vec3(s.occlusion), emitted);
  add_directional(sum, r);
  return sum;
}

#endif
