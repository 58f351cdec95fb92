// Light that no culling concerns: ambient, directional, emitted.
// Needs: `surroundings`, `directional_lights`.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_SURROUNDINGS
#define LAMP_SURROUNDINGS
#include "common/brdf.glsl"

vec3 shade_surroundings(Surface s, Reflector r, vec3 emitted) {
  precise vec3 sum = emitted + surroundings.ambient * s.base_color * (s.occlusion / PI);
  for (uint i = 0u; i < surroundings.directional_count; ++i) {
    const vec3 to_light = -directional_lights[i].direction;
    const float n_l = fused_dot(r.normal, to_light);
    if (n_l <= 0.0) continue;
    const float half_v_l = fused_dot(r.half_eye, to_light);
    sum = fma(reflect_light(r, half_v_l, n_l, n_l), directional_lights[i].illuminance, sum);
  }
  return sum;
}

#endif
