// The convex mesh around what a light reaches, and a margin beyond.
// Based on: the profile is that of the light moved outward by the margin, its arc replaced by tangents; flat sides enclose
// round ones through the circumscribed polygon.
// Promise: encloses every point of the light and every point within the margin of one, for half-angles up to 90 degrees.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_LIGHT_PROXY
#define LAMP_COMMON_LIGHT_PROXY
#include "common/light_bounds.glsl"
#include "common/projection_eye.glsl"
#include "lamplight/shared/proxy.h"

const float HALF_PI = 1.5707963;
const float CIRCUMSCRIBE = 1.0514622;  // 1 / cos(pi / PROXY_SIDES)
const float EVERYWHERE_M = 1e6;        // larger lights would lose their precision as a mesh; they cover the screen

// A pixel's side in metres at a depth, the larger of the two.
float pixel_m(Frame frame, float z_view) {
  const mat4 m = frame.clip_from_view;
  const float w = max(m[3][3] - m[2][3] * z_view, 0.0);
  const vec2 ndc_per_px = 2.0 / vec2(frame.size_px);
  return w * max(ndc_per_px.x / abs(m[0][0]), ndc_per_px.y / abs(m[1][1]));
}

// Five points of half a circle's circumscribed polygon: corners lie between tangents 45 degrees apart.
void sphere_profile(inout LightProxy proxy, float radius) {
  const float corner = radius / cos(0.25 * HALF_PI);
  for (uint i = 0u; i < PROXY_ROWS; ++i) {
    const float angle = HALF_PI * (1.0 - 0.5 * float(i));
    proxy.along[i] = -corner * sin(angle);
    proxy.radius[i] = max(corner * cos(angle), 0.0) * CIRCUMSCRIBE;
  }
  proxy.radius[0] = 0.0;
  proxy.radius[4] = 0.0;
}

// A cone of half-angle a with its cap: a flat base behind the tip, the side moved outward, two tangents of the arc.
void spot_profile(inout LightProxy proxy, Light light, float radius, float margin) {
  const float a = light.outer_angle;
  const float s = light.sin_outer;
  const float c = light.cos_outer;
  const float arc = (radius + margin) / cos(0.25 * a);
  const float side = (radius + margin * (1.0 + sin(0.25 * a))) / cos(0.25 * a);
  proxy.along = float[5](-margin, -margin, side * c - margin * s, arc * cos(0.5 * a), arc);
  proxy.radius = float[5](0.0, margin * (c <= 1e-4 ? 0.0 : (1.0 - s) / c), side * s + margin * c, arc * sin(0.5 * a), 0.0);
  for (uint i = 1u; i < 4u; ++i) proxy.radius[i] *= CIRCUMSCRIBE;
}

// `reach_px`: how far the nearest sample may be from a pixel's centre. The sphere's radius must not be negative.
LightProxy light_proxy(Frame frame, Light light, LightBounds sphere, float reach_px) {
  LightProxy proxy;
  const bool spot = light.type == LIGHT_SPOT;
  proxy.origin = (frame.view_from_world * vec4(light.position, 1.0)).xyz;
  proxy.axis = spot ? normalize(mat3(frame.view_from_world) * light.direction) : vec3(0.0, 0.0, -1.0);
  proxy.z_near = -sphere.center.z - sphere.radius;
  proxy.z_far = -sphere.center.z + sphere.radius;
  const float radius = min(light.range, INFINITE_RADIUS);
  // Where the view stretches, a point of the light lies up to that much aside, and the axis leans as much again.
  const float rounding =
      (ROUND_RADIUS + frame.stretch) * radius +
      ROUND_POSITION * (length(proxy.origin) + length(light.position) + length(frame.eye_world));
  const float margin = 4.0 * rounding + reach_px * pixel_m(frame, proxy.z_far);
  proxy.margin = margin;
  if (spot)
    spot_profile(proxy, light, radius, margin);
  else
    sphere_profile(proxy, radius + margin);
  return proxy;
}

// Never no when the point is inside.
bool may_be_inside(LightProxy proxy, vec3 point) {
  const vec3 offset = point - proxy.origin;
  const float x = dot(offset, proxy.axis);
  const vec2 at = vec2(x, length(offset - x * proxy.axis));
  for (uint i = 0u; i + 1u < PROXY_ROWS; ++i) {
    const vec2 from = vec2(proxy.along[i], proxy.radius[i]);
    const vec2 edge = vec2(proxy.along[i + 1u], proxy.radius[i + 1u]) - from;
    const vec2 outward = vec2(-edge.y, edge.x);
    if (dot(at - from, outward) > 1e-4 * length(outward) * (length(at) + length(from))) return false;
  }
  return true;
}

#endif
