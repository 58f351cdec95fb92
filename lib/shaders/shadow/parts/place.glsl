// Where a light's map holds a point: `shadow_place` of shadow_atlas.h, for shaders.
// Based on: Cigolle et al., A Survey of Efficient Representations for Independent Unit Vectors, JCGT 3:2 (2014).
// Promise: nothing is left to a compiler's contraction, so every shader finds the same texel.
// SPDX-License-Identifier: Apache-2.0
#ifndef SHADOW_PLACE
#define SHADOW_PLACE
#include "shadow/parts/resources.glsl"
#include "common/octahedron.glsl"

struct ShadowPlace {
  vec2 texel;   // from the square's corner; centres at +0.5
  uint square;  // of the light's
  float w;      // depth, m; not > 0: the map does not show the point
  vec3 axis;    // unit, along which depth grows
};

float shadow_dot(vec3 a, vec3 b) {
  precise const float products = LAMP_FMA(a.x, b.x, LAMP_FMA(a.y, b.y, a.z * b.z));
  return products;
}

// `p`: aside at depth 1.
ShadowPlace shadow_place_at(uint light, vec2 p, float w) {
  ShadowPlace place;
  const float middle = float(shadow_maps[light].side) * 0.5;
  const float scale = shadow_maps[light].scale;
  precise const float x = LAMP_FMA(p.x, scale, middle);
  precise const float y = LAMP_FMA(p.y, scale, middle);
  place.texel = vec2(x, y);
  place.w = w;
  place.square = 0u;
  return place;
}

ShadowPlace shadow_place_spot(uint light, vec3 rel) {
  const vec3 x = shadow_maps[light].axis_x;
  const vec3 z = shadow_maps[light].axis_z;
  precise const vec3 y = cross(z, x);
  const float w = shadow_dot(z, rel);
  precise const vec2 p = vec2(shadow_dot(x, rel), shadow_dot(y, rel)) / w;
  ShadowPlace place = shadow_place_at(light, p, w);
  place.axis = z;
  return place;
}

ShadowPlace shadow_place_face(uint light, vec3 rel) {
  const vec3 a = abs(rel);
  vec3 turned = rel.zxy;  // aside in x and y, the longest in z
  uint major = 2u;
  if (a.x >= a.y && a.x >= a.z) {
    turned = rel.yzx;
    major = 0u;
  } else if (a.y >= a.z) {
    turned = rel.zxy;
    major = 1u;
  } else {
    turned = rel.xyz;
  }
  const float w = abs(turned.z);
  precise const vec2 p = turned.xy / w;
  ShadowPlace place = shadow_place_at(light, p, w);
  const float along = octahedron_sign(turned.z);
  place.square = 2u * major + (along < 0.0 ? 1u : 0u);
  place.axis = vec3(major == 0u ? along : 0.0, major == 1u ? along : 0.0, major == 2u ? along : 0.0);
  return place;
}

ShadowPlace shadow_place_octahedron(uint light, vec3 rel) {
  precise const float w = abs(rel.x) + abs(rel.y) + abs(rel.z);
  precise vec2 p = rel.xy / w;
  if (rel.z < 0.0) p = octahedron_folded(p);
  ShadowPlace place = shadow_place_at(light, p, w);
  place.axis = vec3(octahedron_sign(rel.x), octahedron_sign(rel.y), octahedron_sign(rel.z)) * 0.57735027;
  return place;
}

// Of a light that has a map. `rel`: the point from the map's position.
ShadowPlace shadow_place(uint light, vec3 rel) {
  const uint kind = shadow_maps[light].kind;
  if (kind == SHADOW_FACES) return shadow_place_face(light, rel);
  if (kind == SHADOW_SPOT) return shadow_place_spot(light, rel);
  return shadow_place_octahedron(light, rel);
}

// Of a light, where texels lie in the atlas. Who asks for many keeps it.
struct ShadowSquare {
  ivec2 corner;  // texel of the atlas
  int side;      // texels
  bool folds;    // an octahedron
};

ShadowSquare shadow_square(uint light, uint square) {
  const uint corner = shadow_maps[light].squares[square];
  ShadowSquare s;
  s.corner = ivec2(int(corner & 0xffffu), int(corner >> 16u)) * int(LEAST_SQUARE);
  s.side = int(shadow_maps[light].side);
  s.folds = shadow_maps[light].kind == SHADOW_OCTAHEDRON;
  return s;
}

// A texel around a place, in the atlas: an octahedron goes on beyond its edges; other squares have a border, and end.
ivec2 shadow_texel_of(ShadowSquare square, ivec2 texel) {
  const int side = square.side;
  ivec2 t = texel;
  if (square.folds) t = octahedron_texel(texel, side);
  return square.corner + ivec2(clamp(t.x, 0, side - 1), clamp(t.y, 0, side - 1));
}

ivec2 shadow_texel(uint light, uint square, ivec2 texel) { return shadow_texel_of(shadow_square(light, square), texel); }

#endif
