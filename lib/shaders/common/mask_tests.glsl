// A sphere against the occupied parts of a tile's depth range.
// Based on: Harada, A 2.5D Culling for Forward+, SIGGRAPH Asia (2012).
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_MASK_TESTS
#define LAMP_COMMON_MASK_TESTS
#include "common/tile_ranges.glsl"
#include "common/volume_tests.glsl"

// Which of the mask's parts lie between two depths, of `scale` parts a metre.
uint parts_between(vec2 depths, float z_near, float scale, uint mask) {
  const uint first = mask_part(depths.x, z_near, scale);
  const uint last = mask_part(depths.y, z_near, scale);
  return mask & (~0u << first) & (~0u >> (31u - last));
}

// Which of them the sphere may reach.
uint parts_near(LightBounds sphere, float z_near, float scale, uint mask) {
  const float z = -sphere.center.z;
  return parts_between(vec2(z - sphere.radius, z + sphere.radius), z_near, scale, mask);
}

uint parts_near(LightBounds sphere, TileRanges ranges) {
  return parts_near(sphere, ranges.z_near[0], mask_scale(ranges.z_near[0], ranges.z_far[0]), ranges.mask);
}

#endif
