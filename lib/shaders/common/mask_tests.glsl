// A sphere against the occupied parts of a tile's depth range.
// Based on: Harada, A 2.5D Culling for Forward+, SIGGRAPH Asia (2012).
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_MASK_TESTS
#define LAMP_COMMON_MASK_TESTS
#include "common/tile_ranges.glsl"
#include "common/volume_tests.glsl"

// Which of the mask's parts the sphere may reach, of `scale` parts a metre.
uint parts_near(LightBounds sphere, float z_near, float scale, uint mask) {
  const float z = -sphere.center.z;
  const uint first = mask_part(z - sphere.radius, z_near, scale);
  const uint last = mask_part(z + sphere.radius, z_near, scale);
  return mask & (~0u << first) & (~0u >> (31u - last));
}

uint parts_near(LightBounds sphere, TileRanges ranges) {
  return parts_near(sphere, ranges.z_near[0], mask_scale(ranges.z_near[0], ranges.z_far[0]), ranges.mask);
}

#endif
