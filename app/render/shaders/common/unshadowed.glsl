// What a light would bring without its shadow: what leaks and false shadows are parts of.
// Needs: common/lights.glsl.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_UNSHADOWED
#define LAMP_UNSHADOWED
#include "common/luminance.glsl"

// Luminance towards the eye; 0 where the light does not reach the surface or does not face it. `way`: to the light.
float unshadowed_luminance(Reflector r, Emitter e, out Way way) {
  vec3 sum = vec3(0.0);
  if (way_to(r, e.position, e.inverse_range2, way)) add_light_along(sum, r, way, e, is_spot(e));
  return luminance_of(sum);
}

#endif
