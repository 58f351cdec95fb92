// Where a light's shadow lies in the shadow atlas and how a point is looked up in it; and the views that it is drawn
// by. Based on: octahedral maps: Cigolle et al., A Survey of Efficient Representations for Independent Unit Vectors,
// JCGT 3:2 (2014). Within an octant the map is a projection from the light, so rasterization draws it without error.
// Promise: the same bytes in C++ and in GLSL. A point at `p` is at depth w = dot(row_w, p - position) > 0 metres; the
// atlas holds near / w, where nothing was drawn 0.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMPLIGHT_SHARED_SHADOW_H
#define LAMPLIGHT_SHARED_SHADOW_H

#include "glsl.h"

#ifdef __cplusplus
namespace lamp::shared {
#endif

LAMP_CONST SHADOW_NONE = 0u;        // lit: no square, or not drawn yet
LAMP_CONST SHADOW_FACES = 1u;       // six squares: +x -x +y -y +z -z
LAMP_CONST SHADOW_OCTAHEDRON = 2u;  // one square, eight octants
LAMP_CONST SHADOW_SPOT = 3u;        // one square

LAMP_CONST SHADOW_HARD = 0u;
LAMP_CONST SHADOW_PCF = 1u;
LAMP_CONST SHADOW_VSM = 2u;
LAMP_CONST SHADOW_EVSM = 3u;
LAMP_CONST SHADOW_OFF = 4u;  // of a shader: no light has a map, none is looked up

LAMP_CONST LEAST_SQUARE = 16u;  // texels a side
LAMP_CONST MOST_SQUARE = 2048u;
LAMP_CONST SQUARES_A_LIGHT = 6u;
LAMP_CONST VIEWS_A_LIGHT = 8u;

// Of a light as it was when its squares were drawn, which may be some frames ago. All 0: none.
struct ShadowMap {
  vec3 position;    // world, m
  uint kind;        // SHADOW_NONE ...
  vec3 axis_x;      // spots: unit, the direction of a square's x; with axis_z and cross(axis_z, axis_x) at right angles
  float scale;      // texels: how far from the square's middle a direction lies that is 1 aside at depth 1
  vec3 axis_z;      // spots: unit, where the light looks
  float near_m;     // > 0; what is nearer than this is drawn, at this depth
  float range_m;    // of the light; infinite as it says
  uint side;        // of each square, texels
  uint squares[6];  // top left texel over LEAST_SQUARE: x, and y from bit 16 on
};

// What a host draws a square, or an octant of it, by. With rel = world position - position, clip space is
// (dot(row_x, rel), dot(row_y, rel), near_m, dot(row_w, rel)): of the whole atlas, reversed depth, depth clamped, and
// with nothing drawn where a plane says dot(plane, rel) < 0.
struct ShadowView {
  vec3 position;  // world, m
  float near_m;
  vec3 row_x;
  float range_m;  // of the light: what lies beyond casts no shadow that matters
  vec3 row_y;
  uint light;  // index in the frame's lights
  vec3 row_w;
  uint view;       // 0 .. 5 of faces, 0 .. 7 of octants
  vec3 planes[4];  // point inwards; for an octant the last is one of the others
};

#ifdef __cplusplus
static_assert(sizeof(ShadowMap) == 80 && sizeof(ShadowView) == 112);
}  // namespace lamp::shared
#endif

#endif
