// A triangle's normal, right also where the triangle is long and thin: its rounding does not grow with length over width.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_TRIANGLE_NORMAL
#define LAMP_TRIANGLE_NORMAL
#include "common/exact_cross.glsl"

// What rounding took from a - b, of which `rounded` is left.
// Based on: Knuth, The Art of Computer Programming 2, 4.2.2.
vec3 lost_of_difference(vec3 a, vec3 b, vec3 rounded) {
  precise const vec3 taken = a - rounded;
  precise const vec3 lost = (a - (rounded + taken)) + (taken - b);
  return lost;
}

// The cross product of b - a and c - b, about as near as 32 bits can say.
vec3 exact_normal(vec3 a, vec3 b, vec3 c) {
  precise const vec3 p = b - a;
  precise const vec3 q = c - b;
  const Halves p_yz = halves_of(p.yz);
  const Halves q_yz = halves_of(q.yz);
  const Halves p_xy = halves_of(p.xy);
  const Halves q_xy = halves_of(q.xy);
  const Halves p_zx = Halves(vec2(p_yz.high.y, p_xy.high.x), vec2(p_yz.low.y, p_xy.low.x));
  const Halves q_zx = Halves(vec2(q_yz.high.y, q_xy.high.x), vec2(q_yz.low.y, q_xy.low.x));
  const vec3 of_rounded = vec3(cross_of(p.yz, q.yz, p_yz, q_yz), cross_of(p.zx, q.zx, p_zx, q_zx),
                               cross_of(p.xy, q.xy, p_xy, q_xy));
  return of_rounded + (cross(p, lost_of_difference(c, b, q)) + cross(lost_of_difference(b, a, p), q));
}

// At right angles to the triangle, twice its area long. Of its two shorter edges: rounding takes from a product as much as
// the edges are long, and of a long thin triangle's two long edges that may be more than the product. Where the shorter two
// are almost one line, every product is exact: of a sine below 0.03 rounding would leave 2e-6.
vec3 normal_of(vec3 a, vec3 b, vec3 c) {
  const float LEAST_SINE = 0.03;
  const vec3 ab = b - a;
  const vec3 bc = c - b;
  const vec3 ca = a - c;
  const vec3 squares = vec3(dot(ab, ab), dot(bc, bc), dot(ca, ca));
  const float longest = max(squares.x, max(squares.y, squares.z));
  const vec3 normal = squares.x == longest ? cross(bc, ca) : squares.y == longest ? cross(ca, ab) : cross(ab, bc);
  const float shorter = squares.x == longest   ? squares.y * squares.z
                        : squares.y == longest ? squares.z * squares.x
                                               : squares.x * squares.y;
  if (dot(normal, normal) >= LEAST_SINE * LEAST_SINE * shorter) return normal;
  return exact_normal(a, b, c);
}

#endif
