// Light from point and spot lights.
// Based on: Khronos, KHR_lights_punctual: inverse square with a range window, exactly 0 at the range; spot cone squared.
// Promise: adds exactly nothing where the oracle says "outside", so a longer list gives the same bits.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_PUNCTUAL
#define LAMP_PUNCTUAL
#include "common/brdf.glsl"

const float NEAREST_M = 0.01;  // a point light has no size; closer it gets no brighter

// What shading asks of a light.
struct Emitter {
  vec3 position;         // world, m
  float inverse_range2;  // 1 / m^2
  vec3 intensity;        // cd
  float spot_scale;      // of a spot, > 0; of a point 0, and the rest is unset
  vec3 direction;        // unit; where a spot looks
  float cos_outer;       // beyond 1: reaches nothing
};

bool is_spot(Emitter e) { return e.spot_scale > 0.0; }

// 1 in the middle of a cone, 0 from the outer angle on.
float cone_window(Emitter e, float cos_angle) {
  precise const float t = clamp((cos_angle - e.cos_outer) * e.spot_scale, 0.0, 1.0);
  return t * t;
}

// `spot` is is_spot(e), for callers that know it beforehand.
void add_light(inout vec3 sum, Reflector r, Emitter e, bool spot) {
  precise const vec3 offset = e.position - r.position;
  const float d2 = fused_dot(offset, offset);
  precise const float ratio2 = d2 * e.inverse_range2;
  const float n_offset = fused_dot(r.normal, offset);
  if (!(ratio2 < 1.0) || n_offset <= 0.0) return;
  precise const float inverse = min(inversesqrt(d2), 1e6);
  precise const float bounded = min(inverse, 1.0 / NEAREST_M);
  precise float attenuation = fma(-ratio2, ratio2, 1.0) * (bounded * bounded);
  if (spot) {
    precise const float cos_angle = -fused_dot(offset, e.direction) * inverse;
    const float cone = cone_window(e, cos_angle);
    if (cone <= 0.0) return;
    attenuation *= cone;
  }
  precise const float n_l = n_offset * inverse;
  precise const float v_l = fused_dot(r.to_eye, offset) * inverse;
  precise const float arriving = n_l * attenuation;
  sum = fma(reflect_light(r, v_l, n_l, arriving), e.intensity, sum);
}

#endif
