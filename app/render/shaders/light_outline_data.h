// Shapes around lights, as triangles to be drawn as lines.
// Promise: scalar layout, the same bytes in C++ and in GLSL.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_LIGHT_OUTLINE_DATA_H
#define LAMP_LIGHT_OUTLINE_DATA_H

#include "lamplight/shared/glsl.h"
#include "lamplight/shared/radial.h"

#ifdef __cplusplus
namespace lamp::app::gpu {
using namespace lamp::shared;
#endif

LAMP_CONST OUTLINE_PROXY = 0u;  // the mesh that a method rasterises
LAMP_CONST OUTLINE_CUT = 1u;    // the same of a light that is cut to its shadow map, with the method's margin
LAMP_CONST OUTLINE_MESH = 2u;   // what its shadow map lets it light, without a margin
LAMP_CONST OUTLINE_BOUND = 3u;  // how far it reaches by direction, a patch for each byte

LAMP_CONST OUTLINE_TRIANGLES = 2u * RADIAL_SIDE * RADIAL_SIDE;  // of a light, at most: a bound's, two a byte
LAMP_CONST OUTLINE_VERTICES = 3u * OUTLINE_TRIANGLES;

struct OutlineJob {
  uint light;
  uint shape;
};

struct OutlineCorner {
  vec3 position;  // world, m
  uint is_there;  // 0: the shape has no such triangle
};

#ifdef __cplusplus
}  // namespace lamp::app::gpu
#endif

#endif
