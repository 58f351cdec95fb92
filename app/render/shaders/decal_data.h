// A decal as shaders read it: the box that it is projected through, and what is painted there.
// Promise: scalar layout, the same bytes in C++ and in GLSL.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_DECAL_DATA_H
#define LAMP_DECAL_DATA_H

#include "lamplight/shared/entity.h"
#include "lamplight/shared/glsl.h"

#ifdef __cplusplus
namespace lamp::app::gpu {
using namespace lamp::shared;
#endif

LAMP_CONST DECAL_MOSAIC = 0u;    // a round floor of small stones
LAMP_CONST DECAL_PAINTING = 1u;  // a framed fresco
LAMP_CONST DECAL_CRACK = 2u;     // along x
LAMP_CONST DECAL_MOSS = 3u;
LAMP_CONST DECAL_SIGN = 4u;   // an enamelled plate whose arrow points along x
LAMP_CONST DECAL_PLAIN = 5u;  // color_a to the edges of the box: for tests

struct DecalData {
  OrientedBox box;
  vec3 color_a;  // linear
  vec3 color_b;
  uint pattern;
  uint seed;
  float opacity;     // 0 .. 1
  float relief;      // m, height of what the normals show
  float cos_none;    // of the angle between normal and axis_z from which on nothing is painted
  float fade_scale;  // 1 / (cos of the angle up to which all is painted - cos_none)
};

#ifdef __cplusplus
static_assert(sizeof(DecalData) == 108);
}  // namespace lamp::app::gpu
#endif

#endif
