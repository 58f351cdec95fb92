// The rectangle of pixels that a sphere can reach, for every projection of view.h. Never too small.
// Based on: Mara, McGuire, 2D Polyhedral Bounds of a Clipped, Perspective-Projected 3D Sphere, JCGT 2:2 (2013): the
// tangents from the eye, an axis at a time.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_SPHERE_RECTANGLE
#define LAMP_COMMON_SPHERE_RECTANGLE
#include "common/frame.glsl"
#include "lamplight/shared/light.h"

// What 32-bit tangents may be off by, as a share of a slope of 1, and on top of it in pixels.
const float ROUND_SLOPE = 1e-6;
const float ROUND_PX = 0.0625;
const float ANY_SLOPE = 1e9;

// Least and greatest x / z over the part ahead of the eye of a circle at (x, z); z + r > 0.
vec2 slopes_of_circle(float x, float z, float r) {
  const float d2 = x * x + z * z;
  const float t2 = d2 - r * r;
  if (t2 <= 1e-3 * d2) return vec2(-ANY_SLOPE, ANY_SLOPE);  // the eye is inside, or close enough to see half of all
  const float t = sqrt(t2);
  const vec2 low = vec2(x * t - r * z, z * t + r * x);
  const vec2 high = vec2(x * t + r * z, z * t - r * x);
  return vec2(low.y > 0.0 ? low.x / low.y : -ANY_SLOPE, high.y > 0.0 ? high.x / high.y : ANY_SLOPE);
}

// Least and greatest pixel coordinate along one axis (0: x, 1: y).
vec2 pixels_of_sphere(Frame frame, LightBounds sphere, int axis) {
  const mat4 m = frame.clip_from_view;
  const float half_px = 0.5 * float(frame.size_px[axis]);
  const float scale = m[axis][axis];
  vec2 ndc;
  float slack;
  if (m[2][3] == 0.0) {
    const float middle = scale * sphere.center[axis] + m[2][axis] * sphere.center.z + m[3][axis];
    const float reach = sphere.radius * length(vec2(scale, m[2][axis]));
    ndc = vec2(middle - reach, middle + reach) / m[3][3];
    slack = ROUND_SLOPE * half_px * (abs(middle) + reach) / m[3][3];
  } else {
    // Seen from where clip.xyw = 0, which is the eye of every usual projection.
    const float eye_z = -m[3][3] / m[2][3];
    const float eye_x = -(m[2][axis] * eye_z + m[3][axis]) / scale;
    const vec2 slopes = slopes_of_circle(sphere.center[axis] - eye_x, eye_z - sphere.center.z, sphere.radius);
    ndc = (scale * slopes - m[2][axis]) / -m[2][3];
    if (scale < 0.0) ndc = ndc.yx;
    slack = ROUND_SLOPE * half_px * abs(scale / m[2][3]) * (1.0 + min(abs(slopes.x), abs(slopes.y)));
  }
  return (ndc + 1.0) * half_px + vec2(-1.0, 1.0) * (slack + ROUND_PX);
}

// First and last tile, x and y; false if no tile of the picture can be reached.
bool tiles_of_sphere(Frame frame, LightBounds sphere, uint tile_px, out uvec4 tiles) {
  tiles = uvec4(0u);
  if (sphere.radius < 0.0) return false;
  const mat4 m = frame.clip_from_view;
  if (m[2][3] != 0.0 && -sphere.center.z + sphere.radius <= m[3][3] / m[2][3]) return false;  // behind the eye
  const vec2 x = pixels_of_sphere(frame, sphere, 0);
  const vec2 y = pixels_of_sphere(frame, sphere, 1);
  const vec2 size = vec2(frame.size_px);
  if (x.y < 0.0 || y.y < 0.0 || x.x > size.x || y.x > size.y) return false;
  const vec2 low = clamp(vec2(x.x, y.x), vec2(0.0), size - 1.0);
  const vec2 high = clamp(vec2(x.y, y.y), vec2(0.0), size - 1.0);
  tiles = uvec4(uvec2(low) / tile_px, uvec2(high) / tile_px);
  return true;
}

#endif
