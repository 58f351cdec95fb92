// A sphere against the occupied parts of a tile's depth range.
// Based on: Harada, A 2.5D Culling for Forward+, SIGGRAPH Asia (2012).
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_MASK_TESTS
#define LAMP_COMMON_MASK_TESTS
#include "common/tile_ranges.glsl"
#include "common/volume_tests.glsl"

// Which of the mask's parts the sphere may reach.
uint parts_near(LightBounds sphere, TileRanges ranges) {
  const float z = -sphere.center.z;
  const float scale = mask_scale(ranges.z_near[0], ranges.z_far[0]);
  const uint first = mask_part(z - sphere.radius, ranges.z_near[0], scale);
  const uint last = mask_part(z + sphere.radius, ranges.z_near[0], scale);
  return ranges.mask & (~0u << first) & (~0u >> (31u - last));
}

bool sphere_meets_mask(LightBounds sphere, TileRanges ranges) {
  return sphere_touches_depths(sphere, ranges.z_near[0], ranges.z_far[0]) && parts_near(sphere, ranges) != 0u;
}

#endif
