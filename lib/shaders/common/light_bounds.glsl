// A light's bounding sphere in view space, a little too large rather than too small.
// Based on: spots: Primal engine's bounding sphere of a cone with a spherical cap, half-angles up to 45 degrees and above.
// Promise: every point that the oracle says is reached lies inside, for worlds up to 10 km at millimetre scale.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_LIGHT_BOUNDS
#define LAMP_COMMON_LIGHT_BOUNDS
#include "common/frame.glsl"
#include "lamplight/shared/light.h"

const float REACHES_NOTHING = -1e30;
const float INFINITE_RADIUS = 1e18;  // larger than any scene, and its square is still a finite float

// Rounding of 32-bit arithmetic, as a share of the numbers that go in: four units in the last place of the radius,
// and as many of every position that the transform adds up.
const float ROUND_RADIUS = 4e-6;
const float ROUND_POSITION = 1e-6;

LightBounds light_bounds(Frame frame, Light light) {
  if (!(light.range > 0.0)) return LightBounds(vec3(0.0), REACHES_NOTHING);
  vec3 center = light.position;
  float radius = min(light.range, INFINITE_RADIUS);
  if (light.type == LIGHT_SPOT) {
    if (light.outer_angle <= 0.0) return LightBounds(vec3(0.0), REACHES_NOTHING);
    if (radius < INFINITE_RADIUS) {
      const float half_angle_45 = 0.70710678;
      if (light.cos_outer >= half_angle_45) {
        // The sphere through the apex and the rim of the cone.
        const float r = radius / (2.0 * light.cos_outer);
        center += light.direction * r;
        radius = r;
      } else {
        // The rim is a great circle.
        center += light.direction * (radius * light.cos_outer);
        radius *= sqrt(1.0 - light.cos_outer * light.cos_outer);
      }
    }
  }
  const vec3 view_center = (frame.view_from_world * vec4(center, 1.0)).xyz;
  const float slack = ROUND_RADIUS * radius +
                      ROUND_POSITION * (length(view_center) + length(light.position) + length(frame.eye_world));
  return LightBounds(view_center, radius + slack);
}

#endif
