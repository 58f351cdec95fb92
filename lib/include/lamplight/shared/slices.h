// How depth is cut into slices of clusters and bins of lights, and how bins hold their lights.
// Based on: Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017).
// Promise: the same numbers in C++ plans and in GLSL.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMPLIGHT_SHARED_SLICES_H
#define LAMPLIGHT_SHARED_SLICES_H

#include "glsl.h"

#ifdef __cplusplus
namespace lamp::shared {
#endif

LAMP_CONST SLICES_LOG = 0u;
LAMP_CONST SLICES_LINEAR = 1u;
LAMP_CONST_FLOAT MOST_SLICES = 65536.0f;

// log2 and exp2 of different devices and places agree to far better than this share of a depth.
LAMP_CONST_FLOAT SLICE_ROUNDING = 1e-4f;

// Lights that one work group of the sort takes, and the digits it sorts by.
LAMP_CONST SORT_BLOCK = 1024u;
LAMP_CONST SORT_DIGITS = 256u;
LAMP_CONST SORT_DIGIT_BITS = 8u;

// A cluster's range of the shared list: first entry and count. In the place of the count of one that does not fit:
LAMP_CONST NO_RANGE = 0xffffffffu;

// A bin holds the least and the greatest rank of the lights that reach into it: 16 + 16 bits, least in the low half, or
// two words. Least > greatest: no light.
LAMP_CONST MOST_NARROW_LIGHTS = 65535u;
LAMP_CONST EMPTY_BIN = 0x0000ffffu;

#ifdef __cplusplus
}  // namespace lamp::shared
#endif

#endif
