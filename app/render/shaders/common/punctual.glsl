// Light from point and spot lights.
// Based on: Khronos, KHR_lights_punctual: inverse square with a range window, exactly 0 at the range; spot cone squared.
// Promise: adds exactly nothing where the oracle says "outside", so a longer list gives the same bits.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_PUNCTUAL
#define LAMP_PUNCTUAL
#include "common/brdf.glsl"
#include "lamplight/shared/light.h"

const float NEAREST_M2 = 1e-4;  // a point light has no size; closer than 1 cm it gets no brighter

// 1 in the middle of a cone, 0 from the outer angle on.
float cone_window(Light light, vec3 to_light) {
  precise const float cos_angle = -dot(to_light, light.direction);
  if (!(cos_angle > light.cos_outer)) return 0.0;
  precise const float t = clamp((cos_angle - light.cos_outer) * light.spot_scale, 0.0, 1.0);
  return t * t;
}

vec3 shade_light(Surface s, Light light) {
  precise const vec3 offset = light.position - s.position;
  precise const float d2 = dot(offset, offset);
  precise const float range2 = light.range * light.range;
  if (!(d2 < range2)) return vec3(0.0);
  precise const vec3 to_light = offset / max(sqrt(d2), 1e-6);
  const float cone = light.type == LIGHT_SPOT ? cone_window(light, to_light) : 1.0;
  if (cone <= 0.0) return vec3(0.0);
  precise const float ratio2 = d2 / range2;
  precise const float window = clamp(1.0 - ratio2 * ratio2, 0.0, 1.0);
  precise const vec3 incoming = light.intensity * (cone * window / max(d2, NEAREST_M2));
  precise const vec3 reflected = incoming * reflect_light(s, to_light);
  return reflected;
}

#endif
