// A mesh around what a light lights, cut to what its shadow map holds: at most 300 triangles.
// Based on: Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017), "Light Proxy".
// Promise: the same bytes in C++ and in GLSL. A point that a shadow look-up finds lit at all, whatever its normal and
// the seed, lies inside. All zeros: nothing is known, nothing is cut.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMPLIGHT_SHARED_LIGHT_MESH_H
#define LAMPLIGHT_SHARED_LIGHT_MESH_H

#include "glsl.h"

#ifdef __cplusplus
namespace lamp::shared {
#endif

LAMP_CONST MESH_NONE = 0u;  // cuts nothing: no map, or one of another place of the light
LAMP_CONST MESH_CUBE = 1u;  // grids on the faces of a cube, 300 triangles
LAMP_CONST MESH_SPOT = 2u;  // a grid across a spot's square, closed behind the light, 292 triangles

LAMP_CONST MESH_CUBE_QUADS = 5u;   // along a face's side
LAMP_CONST MESH_SPOT_QUADS = 11u;  // along the square's side
LAMP_CONST MESH_SPOT_BACK = 4u;    // points behind the light, the last ones
LAMP_CONST MESH_POINTS = 152u;     // room for those of either
LAMP_CONST MESH_TRIANGLES = 300u;
LAMP_CONST MESH_VERTICES = 900u;

// The mesh also holds each lit point turned about the light by up to this (the sine of the angle), so that a view can
// widen it by a margin: points move outwards, and none stays nearer to the light than the margin over this.
LAMP_CONST_FLOAT MESH_SPREAD = 0.015625f;

// Every triangle is flat in space, and its points lie along fixed directions from `position` (common/light_mesh.glsl).
struct LightMesh {
  vec3 position;     // world, m: of the map
  uint kind;         // MESH_NONE ...
  vec3 axis_x;       // spots: as of the map
  float half_width;  // spots: of the square at depth 1
  vec3 axis_z;
  float unused;
  vec4 reach[38];  // m from `position` to point i: [i / 4][i % 4]
};

#ifdef __cplusplus
static_assert(sizeof(LightMesh) == 656);
}  // namespace lamp::shared
#endif

#endif
