// Light from point and spot lights.
// Based on: Khronos, KHR_lights_punctual: inverse square with a range window, exactly 0 at the range; spot cone squared.
// Promise: adds exactly nothing where the oracle says "outside", so a longer list gives the same bits.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_PUNCTUAL
#define LAMP_PUNCTUAL
#include "common/brdf.glsl"

const float BRIGHTEST = 1e8;     // 1 / m^2: nearer than 0.1 mm no light is brighter; a point would be infinitely so
const float NO_DISTANCE2 = 1e-30;  // m^2, so that nothing is divided by 0

// What shading asks of a light.
struct Emitter {
  vec3 position;         // world, m
  float inverse_range2;  // 1 / m^2
  vec3 intensity;        // cd
  float edge;            // of a spot, > 0: the window of its cone is the square of axis . l - edge, between 0 and 1;
                         // of a point 0, and the rest is unset
  vec3 axis;             // against where the spot looks; as long as the window is steep
};

bool is_spot(Emitter e) { return e.edge > 0.0; }

// The way from a surface to a light.
struct Way {
  vec3 offset;     // m
  float d2;        // its squared length and NO_DISTANCE2
  float ratio2;    // d2 over the squared range
  float n_offset;  // its length along the normal
};

// False if nothing arrives, whatever else the light is.
bool way_to(Reflector r, vec3 position, float inverse_range2, out Way way) {
  precise const vec3 offset = position - r.position;
  precise const float d2 = fma(offset.x, offset.x, fma(offset.y, offset.y, fma(offset.z, offset.z, NO_DISTANCE2)));
  precise const float ratio2 = d2 * inverse_range2;
  way = Way(offset, d2, ratio2, fused_dot(r.normal, offset));
  return ratio2 < 1.0 && way.n_offset > 0.0;
}

// `spot` is is_spot(e), for callers that know it beforehand.
void add_light_along(inout vec3 sum, Reflector r, Way way, Emitter e, bool spot) {
  precise const float inverse = inversesqrt(way.d2);
  precise float attenuation = fma(minus(way.ratio2), way.ratio2, 1.0) * min(inverse * inverse, BRIGHTEST);
  if (spot) {
    precise const float cone = clamp(fma(fused_dot(way.offset, e.axis), inverse, minus(e.edge)), 0.0, 1.0);
    attenuation *= cone * cone;
  }
  precise const float n_l = way.n_offset * inverse;
  precise const vec3 halfway = fma(way.offset, vec3(0.5 * inverse), r.half_eye);
  precise const float arriving = n_l * attenuation;
  sum = fma(reflect_light(r, halfway, n_l, arriving), e.intensity, sum);
}

#endif
