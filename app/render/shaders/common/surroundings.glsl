// Light that no culling concerns: ambient, directional, emitted.
// Needs: `surroundings`, `directional_lights`.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_SURROUNDINGS
#define LAMP_SURROUNDINGS
#include "common/brdf.glsl"

vec3 shade_surroundings(Surface s, vec3 emitted) {
  precise vec3 sum = emitted + surroundings.ambient * s.base_color * (s.occlusion / PI);
  for (uint i = 0u; i < surroundings.directional_count; ++i) {
    precise const vec3 reflected =
        directional_lights[i].illuminance * reflect_light(s, -directional_lights[i].direction);
    sum += reflected;
  }
  return sum;
}

#endif
