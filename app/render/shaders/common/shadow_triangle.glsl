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
#include "common/triangle_normal.glsl"

layout(set = 0, binding = 2, scalar) readonly buffer InstanceBuffer { InstanceData instances[]; };
layout(set = 0, binding = 10, scalar) readonly buffer ViewBuffer { ShadowView views[]; };
layout(set = 0, binding = 11, scalar) readonly buffer CasterBuffer { ShadowCaster casters[]; };
layout(set = 0, binding = 12, scalar) readonly buffer MapBuffer { ShadowMap maps[]; };
layout(set = 0, binding = 13, scalar) readonly buffer DrawBuffer { ShadowDraw draws[]; };
#define VERTEX_BINDING 14
#define INDEX_BINDING 15
#include "common/vertex_words.glsl"

const int SHADOW_BLOCK = 64;  // texels a side that one item is of
const float SLACK_TEXELS = 1.0 / 64.0;

// Of a square: (x, y, w) of a point, x / w and y / w in texels from the square's middle.
struct SquareView {
  mat3 rows;  // columns are x, y, w
  vec3 position;
  float near_m;
  ivec2 corner;  // texel in the atlas
  int side;
  mat3 folds;  // columns: a texel belongs to the view where the dot products with (x, y, 1) are not negative
};

SquareView square_view(uint view, float atlas_size) {
  const uint light = views[view].light;
  const bool octant = maps[light].kind == SHADOW_OCTAHEDRON;
  const uint at = maps[light].squares[maps[light].kind == SHADOW_FACES ? views[view].view : 0u];
  SquareView square;
  square.position = views[view].position;
  square.near_m = views[view].near_m;
  square.corner = ivec2(at & 0xffffu, at >> 16u) * int(LEAST_SQUARE);
  square.side = int(maps[light].side);
  const vec2 off_middle = 0.5 * atlas_size - (vec2(square.corner) + 0.5 * float(square.side));
  const vec3 row_w = views[view].row_w;
  square.rows = mat3(0.5 * atlas_size * views[view].row_x + off_middle.x * row_w,
                     0.5 * atlas_size * views[view].row_y + off_middle.y * row_w, row_w);
  square.folds = mat3(vec3(0.0, 0.0, 1.0), vec3(0.0, 0.0, 1.0), vec3(0.0, 0.0, 1.0));
  if (octant) {
    const mat3 direction_of = inverse(transpose(square.rows));
    square.folds = transpose(direction_of) * mat3(views[view].planes[0], views[view].planes[1], views[view].planes[2]);
  }
  return square;
}

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

// All of the square if a corner is beside or behind the light.
void bound_texels(vec3 a, vec3 b, vec3 c, int side, inout ShadowTriangle t) {
  t.low = ivec2(0);
  t.high = ivec2(side - 1);
  if (min(a.z, min(b.z, c.z)) <= 0.0) return;
  const vec2 pa = a.xy / a.z;
  const vec2 pb = b.xy / b.z;
  const vec2 pc = c.xy / c.z;
  const vec2 to_texel = vec2(0.5 * float(side) - 0.5);
  const vec2 most = vec2(side);
  t.low = max(t.low, ivec2(ceil(clamp(min(pa, min(pb, pc)) + to_texel - SLACK_TEXELS, vec2(-1.0), most))));
  t.high = min(t.high, ivec2(floor(clamp(max(pa, max(pb, pc)) + to_texel + SLACK_TEXELS, vec2(-1.0), most))));
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
  bound_texels(a, b, c, square.side, t);
  const bool seen_from_its_edge = !(t.scale > 0.0);
  if (seen_from_its_edge || max(a.z, max(b.z, c.z)) <= 0.0) t.high = t.low - 1;
  return t;
}

bool is_empty(ShadowTriangle t) { return any(greaterThan(t.low, t.high)); }

// From the square's middle.
vec3 texel_center(SquareView square, ivec2 at) { return vec3(vec2(at) + 0.5 - 0.5 * float(square.side), 1.0); }

// Whether it may cover a texel whose centre lies between these two.
bool may_touch(ShadowTriangle t, vec3 low, vec3 high) {
  const vec3 most = max(t.edge_x * low.x, t.edge_x * high.x) + max(t.edge_y * low.y, t.edge_y * high.y) + t.edge_z;
  const vec3 rounding = 1e-6 * (abs(t.edge_x) * max(abs(low.x), abs(high.x)) +
                                abs(t.edge_y) * max(abs(low.y), abs(high.y)) + abs(t.edge_z));
  return all(greaterThanEqual(most, -rounding));
}

// Distances from the edges, each times a corner's weight over w.
vec3 edges_at(ShadowTriangle t, vec3 s) {
  precise const vec3 at = t.edge_x * s.x + t.edge_y * s.y + t.edge_z;
  return at;
}

#endif
