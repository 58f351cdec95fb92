// How far a light reaches, by direction, before what its shadow map holds stops it: 16 x 16 bytes a light, and two
// coarser levels. Based on: Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017), for
// lights cut by their own shadow maps; octahedral maps: Cigolle et al., JCGT 3:2 (2014). Promise: the same bytes in C++
// and in GLSL. A point that a shadow look-up finds lit at all, whatever its normal and the seed, is no farther from
// `position` than the byte of its direction says. All zeros: nothing is known, nothing is cut.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMPLIGHT_SHARED_RADIAL_H
#define LAMPLIGHT_SHARED_RADIAL_H

#include "glsl.h"

#ifdef __cplusplus
namespace lamp::shared {
#endif

LAMP_CONST RADIAL_NONE = 0u;        // cuts nothing: no map, or one of another place of the light
LAMP_CONST RADIAL_OCTAHEDRON = 1u;  // bytes by octahedral direction
LAMP_CONST RADIAL_SPOT = 2u;        // bytes over the spot's own square

LAMP_CONST RADIAL_SIDE = 16u;   // of the finest level
LAMP_CONST RADIAL_LEVELS = 3u;  // each has half the side of the one before
LAMP_CONST RADIAL_ANY = 255u;   // a byte: as far as the light reaches

struct RadialBound {
  vec3 position;  // world, m: of the map
  uint kind;      // RADIAL_NONE ...
  vec3 axis_x;    // spots: as of the map
  float scale;    // spots: bytes from the square's middle for 1 aside at depth 1
  vec3 axis_z;
  float unit_m;  // of a byte
  // No array of words: spirv-opt would make one type of it and of shared memory of as many, which has no layout.
  // Levels one after the other: 16 x 16, 8 x 8 and 4 x 4 bytes, each the largest of the 2 x 2 below it. Byte (x, y) of
  // n x n is number n y + x of its level; four a word, the first lowest.
  uvec4 bytes[21];
};

// A light whose bound is to be made: its index, and whether its map shows all that it reaches now (shadow_shows_all).
// Several work groups may share a large map: as many jobs, one for each part, after shadow/clear_radial_bounds.
struct RadialJob {
  uint light;
  uint shows_all;
  uint part;   // 0 .. parts - 1
  uint parts;  // 0 and 1: the whole map; at most RADIAL_MOST_PARTS
};
LAMP_CONST RADIAL_MOST_PARTS = 16u;

#ifdef __cplusplus
static_assert(sizeof(RadialBound) == 384);
}  // namespace lamp::shared
#endif

#endif
