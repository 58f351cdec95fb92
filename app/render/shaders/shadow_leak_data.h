// Light that a shadow filter lets through or stops, of a pixel, by what rays say of it.
// Promise: scalar layout, the same bytes in C++ and in GLSL.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_SHADOW_LEAK_DATA_H
#define LAMP_SHADOW_LEAK_DATA_H

#include "lamplight/shared/glsl.h"

#ifdef __cplusplus
namespace lamp::app::gpu {
using namespace lamp::shared;
#endif

LAMP_CONST LEAK_FOUND = 0u;
LAMP_CONST LEAK_SKY = 1u;    // no surface
LAMP_CONST LEAK_ENDED = 2u;  // the device ended the search: the pixel's light is not known

// Of the lights in a pixel's list that reach it and face it. Light is luminance towards the eye, without shadows.
struct ShadowLeak {
  float arriving;  // that no ray stops
  float stopped;   // that rays stop
  float leaked;    // of the stopped, what the filter lets through
  float lost;      // of the arriving, what the filter stops: false shadow
  uint unclear;    // lights left out: other ends of the ray give another answer
  uint found;      // LEAK_FOUND ...
};

// Push constants.
struct ShadowLeakAsked {
  uint first_row;    // of the picture; the buffer begins there
  uint first_light;  // entities to answer for
  uint end_light;
  uint root;  // of the hierarchy
  uint two;   // for loops_ended
  // Rays end so far before the surface and the light: the shorter, and one to see what hangs on it. Each is as much of
  // the ray at most.
  vec2 ends_m;
  vec2 end_shares;
  vec2 off;  // how far depth may be off its triangle: a share of the distance ahead, and of coordinates
};

#ifdef __cplusplus
static_assert(sizeof(ShadowLeak) == 24 && sizeof(ShadowLeakAsked) == 44);
}  // namespace lamp::app::gpu
#endif

#endif
