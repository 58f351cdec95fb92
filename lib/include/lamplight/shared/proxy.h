// Light proxies: convex meshes that enclose what a light reaches, drawn to find the tiles that it touches.
// Based on: Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017), rasterised culling.
// Promise: the same bytes in C++ plans and in GLSL.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMPLIGHT_SHARED_PROXY_H
#define LAMPLIGHT_SHARED_PROXY_H

#include "glsl.h"

#ifdef __cplusplus
namespace lamp::shared {
#endif

// A profile of five points, turned around the axis in steps: ten sides, 60 triangles. A sphere's profile is half a
// circle, a spot's is its cone with the cap. The first and the last point lie on the axis.
LAMP_CONST PROXY_ROWS = 5u;
LAMP_CONST PROXY_SIDES = 10u;
LAMP_CONST PROXY_VERTICES = 180u;

struct LightProxy {
  vec3 origin;   // view space, m
  float z_near;  // depths that the light reaches, metres ahead
  vec3 axis;     // view space, unit
  float z_far;
  float along[5];   // m along the axis, of each point of the profile
  float radius[5];  // m from the axis, so large that the flat sides enclose the round ones
  float margin;     // m, that the mesh holds beyond what the light reaches
};

// Who is drawn: lights outside which the eye is, then such that it may be inside of; and the same of lights whose mesh
// is cut (shared/light_mesh.h). Each an indirect draw.
LAMP_CONST PROXIES_OUTSIDE = 0u;
LAMP_CONST PROXIES_INSIDE = 1u;
LAMP_CONST CUT_OUTSIDE = 2u;
LAMP_CONST CUT_INSIDE = 3u;

// What fragments of a face do to clusters: mark those that the back face lies in; walk from the front face to the mark;
// or, where the eye may be inside, set all up to the back face.
LAMP_CONST CLUSTERS_MARK = 0u;
LAMP_CONST CLUSTERS_WALK = 1u;
LAMP_CONST CLUSTERS_FROM_EYE = 2u;

// What fragments of a face do to tiles: set the light's bit; of two passes, set its stencil bit, then set its bit where
// the stencil bit is set.
LAMP_CONST TILES_ONE_PASS = 0u;
LAMP_CONST TILES_STENCIL = 1u;
LAMP_CONST TILES_BEHIND = 2u;

struct ProxyDraw {
  uint vertices;
  uint instances;
  uint first_vertex;
  uint first_instance;
};

#ifdef __cplusplus
static_assert(sizeof(LightProxy) == 76 && sizeof(ProxyDraw) == 16);
}  // namespace lamp::shared
#endif

#endif
