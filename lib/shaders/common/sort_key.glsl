// The key that lights are sorted by: a number, or how far ahead the middle of their bounding sphere lies.
// Promise: unsigned order of keys is order of depths; lights that reach nothing come last.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_SORT_KEY
#define LAMP_COMMON_SORT_KEY
#include "common/frame.glsl"
#include "common/ordered_float.glsl"
#include "lamplight/shared/light.h"
#include "lamplight/shared/slices.h"

uint sort_key(LightBounds sphere) { return sphere.radius < 0.0 ? ~0u : ordered_bits(-sphere.center.z); }

uint sort_digit(uint key, uint shift) { return key >> shift & (SORT_DIGITS - 1u); }
uint sort_digit(LightBounds sphere, uint shift) { return sort_digit(sort_key(sphere), shift); }

// Blocks that hold a light. Passes may be dispatched for more lights than there are; groups beyond have nothing to do.
uint sort_blocks(Frame frame) { return (light_count_of(frame) + SORT_BLOCK - 1u) / SORT_BLOCK; }

#endif
