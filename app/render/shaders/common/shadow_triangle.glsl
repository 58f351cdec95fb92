// A caster's triangle as one square of the shadow atlas shows it, and which texels it covers: no clipping, and no gap
// between triangles that share an edge, since both sides compute the edge from the same numbers.
// Based on: Olano and Greer, Triangle Scan Conversion using 2D Homogeneous Coordinates, Graphics Hardware 1997.
// Promise: a texel holds the nearest triangle at its centre, as near / w; depth is exact within rounding, as near / w is
// linear over the square.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_SHADOW_TRIANGLE
#define LAMP_SHADOW_TRIANGLE
#extension GL_EXT_scalar_block_layout : require
#include "scene_data.h"
#include "shadow_data.h"
#include "common/shadow_square.glsl"
#include "common/triangle_normal.glsl"

layout(set = 0, binding = 2, scalar) readonly buffer InstanceBuffer { InstanceData instances[]; };
layout(set = 0, binding = 11, scalar) readonly buffer CasterBuffer { ShadowCaster casters[]; };
layout(set = 0, binding = 13, scalar) readonly buffer DrawBuffer { ShadowDraw draws[]; };
#define VERTEX_BINDING 14
#define INDEX_BINDING 15
#include "common/vertex_words.glsl"

const int SHADOW_BLOCK = 64;  // texels a side that one item is of
const float SLACK_TEXELS = 1.0 / 64.0;

struct ShadowTriangle {
  vec3 edge_x;  // of the three edges: edge_x * x + edge_y * y + edge_z is not negative inside
  vec3 edge_y;
  vec3 edge_z;
  vec3 plane;  // its dot product with (x, y, 1), over `scale`, is 1 / w
  float scale;
  ivec2 low;   // texels of the square that it may cover; none where low > high
  ivec2 high;
  uvec3 vertices;  // words
};

vec3 vertex_in(SquareView square, uint instance, uint word) {
  precise const vec3 rel = (instances[instance].world_from_object * vec4(vertex_3(word), 1.0)).xyz - square.position;
  precise const vec3 seen = rel * square.rows;
  return seen;
}

// Turned round it is the same but for the sign, which a contracted product would not be.
vec3 edge_of(vec3 a, vec3 b) {
  precise const vec3 edge = a.yzx * b.zxy - a.zxy * b.yzx;
  return edge;
}

// All of the view if a corner is beside or behind the light.
void bound_texels(vec3 a, vec3 b, vec3 c, SquareView square, inout ShadowTriangle t) {
  t.low = square.low;
  t.high = square.high;
  if (min(a.z, min(b.z, c.z)) <= 0.0) return;
  const vec2 pa = a.xy / a.z;
  const vec2 pb = b.xy / b.z;
  const vec2 pc = c.xy / c.z;
  const vec2 to_texel = vec2(0.5 * float(square.side) - 0.5);
  const vec2 most = vec2(square.side);
  t.low = max(t.low, ivec2(ceil(clamp(min(pa, min(pb, pc)) + to_texel - SLACK_TEXELS, vec2(-1.0), most))));
  t.high = min(t.high, ivec2(floor(clamp(max(pa, max(pb, pc)) + to_texel + SLACK_TEXELS, vec2(-1.0), most))));
}

// Whether all corners are beyond one fold of the octant, by more than rounding.
bool is_beyond_fold(SquareView square, vec3 a, vec3 b, vec3 c) {
  if (!square.is_octant) return false;
  const vec3 farthest = max(a * square.folds, max(b * square.folds, c * square.folds));
  const vec3 size = max(abs(a), max(abs(b), abs(c)));
  const mat3 folds = mat3(abs(square.folds[0]), abs(square.folds[1]), abs(square.folds[2]));
  return any(lessThan(farthest, -1e-5 * (size * folds)));
}

ShadowTriangle shadow_triangle(SquareView square, uint caster, uint number) {
  ShadowTriangle t;
  t.vertices = vertices_at(draws[caster].first_index + 3u * number, draws[caster].vertex_offset);
  const uint instance = casters[caster].instance;
  const vec3 a = vertex_in(square, instance, t.vertices.x);
  const vec3 b = vertex_in(square, instance, t.vertices.y);
  const vec3 c = vertex_in(square, instance, t.vertices.z);
  t.plane = normal_of(a, b, c);
  t.scale = dot(t.plane, a);
  // Both sides cast: what is closed casts the same, what is a sheet is seen from both.
  const float side = t.scale < 0.0 ? -1.0 : 1.0;
  t.plane *= side;
  t.scale *= side;
  const mat3 of_edges = transpose(side * mat3(edge_of(b, c), edge_of(c, a), edge_of(a, b)));
  t.edge_x = of_edges[0];
  t.edge_y = of_edges[1];
  t.edge_z = of_edges[2];
  bound_texels(a, b, c, square, t);
  const bool seen_from_its_edge = !(t.scale > 0.0);
  if (seen_from_its_edge || max(a.z, max(b.z, c.z)) <= 0.0 || is_beyond_fold(square, a, b, c)) t.high = t.low - 1;
  return t;
}

bool is_empty(ShadowTriangle t) { return any(greaterThan(t.low, t.high)); }

// Whether x * p.x + y * p.y + z may be as much as 0 in all three for a p between these two.
bool may_be_inside(vec3 x, vec3 y, vec3 z, vec2 low, vec2 high) {
  const vec3 most = max(x * low.x, x * high.x) + max(y * low.y, y * high.y) + z;
  const vec2 farthest = max(abs(low), abs(high));
  return all(greaterThanEqual(most, -1e-6 * (abs(x) * farthest.x + abs(y) * farthest.y + abs(z))));
}

// Whether it may cover a texel of the view whose centre lies between these two.
bool may_touch(SquareView square, ShadowTriangle t, vec3 low, vec3 high) {
  if (!may_be_inside(t.edge_x, t.edge_y, t.edge_z, low.xy, high.xy)) return false;
  const mat3 folds = transpose(square.folds);
  return !square.is_octant || may_be_inside(folds[0], folds[1], folds[2], low.xy, high.xy);
}

// Distances from the edges, each times a corner's weight over w.
vec3 edges_at(ShadowTriangle t, vec3 s) {
  precise const vec3 at = t.edge_x * s.x + t.edge_y * s.y + t.edge_z;
  return at;
}

#endif
