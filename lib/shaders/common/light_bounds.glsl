// A light's bounding sphere in view space, a little too large rather than too small.
// Based on: spots: Primal engine's bounding sphere of a cone with a spherical cap, half-angles up to 45 degrees and above.
// Promise: every point that the oracle says is reached lies inside, for worlds up to 10 km at millimetre scale.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_LIGHT_BOUNDS
#define LAMP_COMMON_LIGHT_BOUNDS
#include "common/frame.glsl"
#include "lamplight/shared/light.h"

LightSphere light_sphere(Light light) {
  if (!(light.range > 0.0)) return LightSphere(vec3(0.0), REACHES_NOTHING);
  if (light.type == LIGHT_SPOT && light.outer_angle <= 0.0) return LightSphere(vec3(0.0), REACHES_NOTHING);
  // Around the origin, where scenes are, wherever the light may be.
  if (light.range >= INFINITE_RADIUS) return LightSphere(vec3(0.0), INFINITE_RADIUS);
  if (light.type != LIGHT_SPOT) return LightSphere(light.position, light.range);
  // A narrow cone's sphere goes through the apex and the rim; that of a wide one has the rim as a great circle.
  const float cos_45 = 0.70710678;
  const float shift = min(light.range * light.cos_outer, light.range / (2.0 * max(light.cos_outer, cos_45)));
  return LightSphere(light.position + light.direction * shift, max(light.range * light.sin_outer, shift));
}

LightBounds view_bounds(Frame frame, LightSphere sphere) {
  const vec3 center = (frame.view_from_world * vec4(sphere.center, 1.0)).xyz;
  // A spot's tip, which rounds as well, is within two radii of the centre.
  const float slack = (ROUND_RADIUS + 2.0 * ROUND_POSITION + frame.stretch) * sphere.radius +
                      ROUND_POSITION * (length(center) + length(sphere.center) + length(frame.eye_world));
  // Without a branch: compilers load what comes behind one only then.
  const bool reaches = sphere.radius >= 0.0;
  return LightBounds(reaches ? center : vec3(0.0), reaches ? sphere.radius + slack : REACHES_NOTHING);
}

LightBounds light_bounds(Frame frame, Light light) { return view_bounds(frame, light_sphere(light)); }

#endif
