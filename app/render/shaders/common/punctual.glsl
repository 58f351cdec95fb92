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
  // The cosine of two rounded unit vectors may exceed 1; an angle of 0 reaches nothing all the same.
  if (!(cos_angle > light.cos_outer) || light.outer_angle <= 0.0) return 0.0;
  precise const float t = clamp((cos_angle - light.cos_outer) * light.spot_scale, 0.0, 1.0);
  return t * t;
}

// What a light's distance leaves of it: the direction to it, and its attenuation, 0 from the range on.
struct Falloff {
  vec3 to_light;
  float attenuation;
};

Falloff falloff(Surface s, Light light) {
  precise const vec3 offset = light.position - s.position;
  precise const float d2 = dot(offset, offset);
  precise const float range2 = light.range * light.range;
  if (!(d2 < range2)) return Falloff(vec3(0.0), 0.0);
  precise const vec3 to_light = offset / max(sqrt(d2), 1e-6);
  precise const float ratio2 = d2 / range2;
  precise const float window = clamp(1.0 - ratio2 * ratio2, 0.0, 1.0);
  precise const float attenuation = window / max(d2, NEAREST_M2);
  return Falloff(to_light, attenuation);
}

vec3 shade_point(Surface s, Light light) {
  const Falloff f = falloff(s, light);
  if (f.attenuation <= 0.0) return vec3(0.0);
  precise const vec3 reflected = light.intensity * f.attenuation * reflect_light(s, f.to_light);
  return reflected;
}

vec3 shade_spot(Surface s, Light light) {
  const Falloff f = falloff(s, light);
  if (f.attenuation <= 0.0) return vec3(0.0);
  const float cone = cone_window(light, f.to_light);
  if (cone <= 0.0) return vec3(0.0);
  precise const vec3 reflected = light.intensity * (cone * f.attenuation) * reflect_light(s, f.to_light);
  return reflected;
}

vec3 shade_light(Surface s, Light light) {
  return light.type == LIGHT_SPOT ? shade_spot(s, light) : shade_point(s, light);
}

#endif
