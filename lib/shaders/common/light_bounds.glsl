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

LightSphere light_sphere(Light light) {
  if (!(light.range > 0.0)) return LightSphere(vec3(0.0), REACHES_NOTHING);
  LightSphere sphere = LightSphere(light.position, min(light.range, INFINITE_RADIUS));
  if (light.type != LIGHT_SPOT) return sphere;
  if (light.outer_angle <= 0.0) return LightSphere(vec3(0.0), REACHES_NOTHING);
  if (sphere.radius >= INFINITE_RADIUS) return sphere;
  const float half_angle_45 = 0.70710678;
  if (light.cos_outer >= half_angle_45) {
    // The sphere through the apex and the rim of the cone.
    sphere.radius /= 2.0 * light.cos_outer;
    sphere.center += light.direction * sphere.radius;
  } else {
    // The rim is a great circle.
    sphere.center += light.direction * (sphere.radius * light.cos_outer);
    sphere.radius *= sqrt(1.0 - light.cos_outer * light.cos_outer);
  }
  return sphere;
}

LightBounds view_bounds(Frame frame, LightSphere sphere) {
  if (sphere.radius < 0.0) return LightBounds(vec3(0.0), REACHES_NOTHING);
  const vec3 center = (frame.view_from_world * vec4(sphere.center, 1.0)).xyz;
  // A spot's tip, which rounds as well, is within two radii of the centre.
  const float slack = (ROUND_RADIUS + 2.0 * ROUND_POSITION) * sphere.radius +
                      ROUND_POSITION * (length(center) + length(sphere.center) + length(frame.eye_world));
  return LightBounds(center, sphere.radius + slack);
}

LightBounds light_bounds(Frame frame, Light light) { return view_bounds(frame, light_sphere(light)); }

#endif
