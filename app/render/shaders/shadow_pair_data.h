// What is asked of shadows of pairs of pixel and light, and what the look-up answers.
// Promise: scalar layout, the same bytes in C++ and in GLSL.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_SHADOW_PAIR_DATA_H
#define LAMP_SHADOW_PAIR_DATA_H

#include "lamplight/shared/glsl.h"

#ifdef __cplusplus
namespace lamp::app::gpu {
using namespace lamp::shared;
#endif

// What all texels that have a say in a look-up say of its point, each compared by itself, as `hard` does. Blurred
// moments, too, have their say through the depths of these texels alone.
LAMP_CONST TEXELS_DIFFER = 0u;  // or the light has no map that shows the point
LAMP_CONST TEXELS_DARK = 1u;
LAMP_CONST TEXELS_LIT = 2u;

// Push constants.
struct ShadowQuestion {
  uint pairs;
  uint texels;  // 0: `compared` and `texels` are not asked for
};

struct ShadowPair {
  uint pixel;  // row by row
  uint light;
};

struct ShadowAnswer {
  float light;     // luminance towards the eye, without shadows
  float share;     // of it, that the filter leaves
  float compared;  // of it, that the same taps would leave if each compared depths, as those of pcf do
  uint reached;    // 1: the radial bound lets it
  uint held;       // 1: the light's mesh holds it, or there is none
  uint texels;     // TEXELS_DIFFER ...
};

#ifdef __cplusplus
static_assert(sizeof(ShadowPair) == 8 && sizeof(ShadowAnswer) == 24);
}  // namespace lamp::app::gpu
#endif

#endif
