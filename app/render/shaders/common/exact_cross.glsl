// Cross products in the plane whose sign is right, also of long thin triangles: each product with what rounding took from it.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_EXACT_CROSS
#define LAMP_EXACT_CROSS

// In two parts of half the bits, whose products are exact.
// Based on: Dekker, A Floating-Point Technique for Extending the Available Precision, Numerische Mathematik 18 (1971).
struct Halves {
  vec2 high;
  vec2 low;
};

Halves halves_of(vec2 v) {
  precise const vec2 scaled = 4097.0 * v;  // 2^12 + 1
  precise const vec2 high = scaled - (scaled - v);
  precise const vec2 low = v - high;
  return Halves(high, low);
}

// What rounding took from p * q = `rounded`; the same of q and p.
float lost_of(float rounded, float p_high, float p_low, float q_high, float q_low) {
  precise const float lost = (p_high * q_high - rounded) + (p_high * q_low + p_low * q_high) + p_low * q_low;
  return lost;
}

// p.x q.y - p.y q.x, about as near as 32 bits can say. Of q and p it is the same number with the other sign, however sums
// are rounded: so the two triangles at an edge agree on who has a ray.
float cross_of(vec2 p, vec2 q, Halves p2, Halves q2) {
  precise const vec2 rounded = p * q.yx;
  precise const float lost_x = lost_of(rounded.x, p2.high.x, p2.low.x, q2.high.y, q2.low.y);
  precise const float lost_y = lost_of(rounded.y, p2.high.y, p2.low.y, q2.high.x, q2.low.x);
  precise const float of_edge = (rounded.x - rounded.y) + (lost_x - lost_y);
  return of_edge;
}

float largest_of(vec2 a, vec2 b, vec2 c) {
  const vec2 most = max(abs(a), max(abs(b), abs(c)));
  return max(most.x, most.y);
}

// Whether a ray through 0 passes by a triangle, so far that rounding of plain products cannot matter.
bool passes_by(vec2 a, vec2 b, vec2 c) {
  const float size = largest_of(a, b, c);
  const float room = 1e-6 * size * size;  // two products and their difference are off by half of it, however rounded
  const vec3 of_edges = vec3(c.x * b.y - c.y * b.x, a.x * c.y - a.y * c.x, b.x * a.y - b.y * a.x);
  return min(of_edges.x, min(of_edges.y, of_edges.z)) < -room && max(of_edges.x, max(of_edges.y, of_edges.z)) > room;
}

#endif
