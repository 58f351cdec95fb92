// Which bytes of a radial bound's finest level directions to a sphere may touch.
// Promise: never too few; the same in every shader.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_RADIAL_AREAS
#define LAMP_COMMON_RADIAL_AREAS
#include "common/octahedron.glsl"
#include "common/radial_levels.glsl"

// Bytes of the finest level, those beside the square as well.
struct RadialArea {
  ivec2 low;
  ivec2 high;
};

RadialArea radial_area(vec2 low, vec2 high) {
  return RadialArea(ivec2(floor(low - RADIAL_ROUNDING)), ivec2(floor(high + RADIAL_ROUNDING)));
}

const float RADIAL_MOST_SINE = 0.7;  // of angles: wider ones are not looked at

float radial_angle(float sine) { return sine + 0.571 * sine * sine * sine; }  // at least asin(sine)

// How far the octahedron's map may lie beside that of a direction when that turns by an angle. The map is v / s with
// s = |x| + |y| + |z|, or below 1 minus its absolute values. Its x changes by sqrt(1 - 2 q + 3 q^2) / s along one radian,
// with q = |x| / s. That is at most sqrt(2), and so is what s changes by; the root is largest at one of the ends of q.
// `least`, `most`: of q, of x and of y; `sum`: at least s.
float radial_aside(vec2 least, vec2 most, float sum, float angle) {
  precise const float farthest = 1.4143 * angle;
  precise const vec4 q = clamp(vec4(least - farthest, most + farthest), 0.0, 1.0);
  precise const vec4 squares = 1.0 - 2.0 * q + 3.0 * q * q;
  precise const float root = sqrt(max(max(squares.x, squares.y), max(squares.z, squares.w)));
  precise const float aside = angle * root / max(1.0, sum - farthest);
  return aside;
}

// Of directions to a sphere.
RadialArea radial_area_of_sphere(vec3 direction, float sine) {
  precise const float sum = abs(direction.x) + abs(direction.y) + abs(direction.z);
  precise const vec2 p = direction.xy / sum;
  const float aside = radial_aside(abs(p), abs(p), sum, radial_angle(sine));
  const float half_side = 0.5 * float(RADIAL_SIDE);
  precise const vec2 place = half_side * ((direction.z < 0.0 ? octahedron_folded(p) : p) + 1.0);
  precise const float around = half_side * aside;
  return radial_area(place - around, place + around);
}

// Of a sphere before a spot, whose square goes on as at its edges.
RadialArea radial_area_of_spot(float scale, vec3 center, float radius) {
  precise const vec4 ends = vec4(center.xy - radius, center.xy + radius);
  precise const vec4 nearer = ends * (scale / (center.z - radius));
  precise const vec4 farther = ends * (scale / (center.z + radius));
  const vec4 middle = vec4(0.5 * float(RADIAL_SIDE));
  const vec4 most = vec4(RADIAL_SIDE);
  const vec4 area = clamp(middle + vec4(min(nearer.xy, farther.xy), max(nearer.zw, farther.zw)), -most, 2.0 * most);
  RadialArea bytes = radial_area(area.xy, area.zw);
  bytes.low = clamp(bytes.low, 0, int(RADIAL_SIDE) - 1);
  bytes.high = clamp(bytes.high, 0, int(RADIAL_SIDE) - 1);
  return bytes;
}

#endif
