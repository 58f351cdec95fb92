// What tiled culling keeps of a tile: its depth ranges, its frustum as a cone, and the names of its variants.
// Based on: Stewart, Compute-Based Tiled Culling, GPU Pro 7 (2016), 1.4; Harada, A 2.5D Culling for Forward+, SIGGRAPH
// Asia (2012); Primal engine, Light Culling with Approximate Sphere-Cone Intersection.
// Promise: the same numbers in C++ plans and in GLSL.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMPLIGHT_SHARED_TILE_H
#define LAMPLIGHT_SHARED_TILE_H

#include "glsl.h"

#ifdef __cplusplus
namespace lamp::shared {
#endif

// bounds: how a tile's depths are kept
LAMP_CONST BOUNDS_MINMAX = 0u;
LAMP_CONST BOUNDS_HALF = 1u;
LAMP_CONST BOUNDS_MODIFIED_HALF = 2u;
LAMP_CONST BOUNDS_MASK = 3u;
LAMP_CONST BOUNDS_NONE = 4u;
// test: a sphere against the tile
LAMP_CONST TEST_PLANES = 0u;
LAMP_CONST TEST_AABB = 1u;
LAMP_CONST TEST_PLANES_AABB = 2u;
LAMP_CONST TEST_CONE_APPROXIMATE = 3u;
LAMP_CONST TEST_CONE = 4u;
LAMP_CONST TEST_EXACT = 5u;
// spot: what a spot light passes after its sphere
LAMP_CONST SPOT_SPHERE = 0u;
LAMP_CONST SPOT_CONE_PLANES = 1u;
LAMP_CONST SPOT_CONE_SPHERE = 2u;
LAMP_CONST SPOT_CONE_SEGMENTS = 3u;
// order of a list
LAMP_CONST ORDER_INDEX = 0u;
LAMP_CONST ORDER_TYPE = 1u;
LAMP_CONST ORDER_APPEND = 2u;

// In a list by type, this bit of an entry says that the light is a spot.
LAMP_CONST TYPE_BIT = 0x80000000u;

// Depths of a tile's pixels, metres ahead. An empty range has z_near > z_far.
struct TileRanges {
  float z_near[2];  // of the near and of the far range; bounds with one range leave the second empty
  float z_far[2];
  float split;  // pixels up to this depth belong to the near range
  uint mask;    // bounds mask: bit i: a pixel lies in the i-th of 32 equal parts of the near range; others: all ones
};

// A tile's frustum as the eye sees it, for every kind of test (64 bytes of planes) or as a cone (16 bytes).
struct TilePlanes {
  vec4 planes[4];  // left, right, top, bottom; view space, unit normals, positive inside
};
struct TileCone {
  vec3 axis;    // perspective: unit direction through the tile's middle; orthographic: x and y of its middle where z is
                // 0, then how long a line of sight is for each metre ahead
  float slope;  // >= 0: radius per metre, along z (approximate test) or along the axis (exact); < 0: minus the radius
};

#ifdef __cplusplus
static_assert(sizeof(TileRanges) == 24 && sizeof(TilePlanes) == 64 && sizeof(TileCone) == 16);
}  // namespace lamp::shared
#endif

#endif
