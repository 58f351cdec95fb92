// The key that lights are sorted by: how far ahead the middle of their bounding sphere lies.
// Promise: unsigned order of keys is order of depths; lights that reach nothing come last.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_SORT_KEY
#define LAMP_COMMON_SORT_KEY
#include "common/frame.glsl"
#include "lamplight/shared/light.h"
#include "lamplight/shared/slices.h"

// Floats sort like their bits, once negative ones are turned over.
uint sort_key(LightBounds sphere) {
  if (sphere.radius < 0.0) return ~0u;
  const uint bits = floatBitsToUint(-sphere.center.z);
  return (bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u;
}

uint sort_digit(LightBounds sphere, uint shift) { return sort_key(sphere) >> shift & (SORT_DIGITS - 1u); }

// Blocks that hold a light. Passes may be dispatched for more lights than there are; groups beyond have nothing to do.
uint sort_blocks(Frame frame) { return (light_count_of(frame) + SORT_BLOCK - 1u) / SORT_BLOCK; }

#endif
