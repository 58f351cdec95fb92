// A tile's depth ranges: one, or two halves of it, or one with a mask of its occupied parts; or every depth there is.
// Based on: Stewart, Compute-Based Tiled Culling, GPU Pro 7 (2016), 1.4.2 (Half Z, Modified Half Z); Harada, A 2.5D
// Culling for Forward+, SIGGRAPH Asia (2012).
// Needs: TILE_PX, BOUNDS.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_TILE_RANGES
#define LAMP_COMMON_TILE_RANGES
#include "common/tile_depth.glsl"
#include "lamplight/shared/tile.h"

const uint MASK_BITS = 32u;
const float EMPTY_NEAR = 1.0;
const float EMPTY_FAR = -1.0;
const float ANY_DEPTH = 1e30;  // m: beyond every light, and far enough from infinity to be added to
// A part of a mask is no shorter than 16 steps between numbers as large as its depths. Else depths of one surface, which
// differ in their last digit, would lie in parts at both ends of it.
const float LEAST_RANGE = 1.0 / 16384.0;  // of the depth

TileRanges masked_range(float z_near, float z_far, uint mask) {
  return TileRanges(float[2](z_near, EMPTY_NEAR), float[2](z_far, EMPTY_FAR), z_far, mask);
}

TileRanges one_range(float z_near, float z_far) { return masked_range(z_near, z_far, ~0u); }

TileRanges empty_ranges() { return masked_range(EMPTY_NEAR, EMPTY_FAR, 0u); }

bool is_empty(TileRanges ranges) { return ranges.z_near[0] > ranges.z_far[0]; }

TileRanges half_ranges(float z_near, float z_far) {
  precise const float split = 0.5 * (z_near + z_far);
  return TileRanges(float[2](z_near, split), float[2](split, z_far), split, ~0u);
}

// Halfway from the near half's farthest surface to the far half's nearest, so that a pixel is on its own side however its
// depth was rounded.
float split_between(TileRanges ranges) {
  return ranges.z_near[1] > ranges.z_far[1] ? ANY_DEPTH : 0.5 * (ranges.z_far[0] + ranges.z_near[1]);
}

// The length of a part, m, and how many there are in a metre.
float mask_step(float z_near, float z_far) {
  const float least = max(LEAST_RANGE * max(abs(z_near), abs(z_far)), 1e-30);
  return max(z_far - z_near, least) / float(MASK_BITS);
}
float mask_scale(float z_near, float z_far) { return 1.0 / mask_step(z_near, z_far); }

// Which of 32 equal parts of the range a depth lies in; the slack of light bounds covers what rounding moves.

uint mask_part(float z_view, float z_near, float scale) {
  return uint(clamp((z_view - z_near) * scale, 0.0, float(MASK_BITS - 1u)));
}

// How many bits are set without a gap, from the lowest.
uint bits_in_a_row(uint bits) { return bits == ~0u ? 32u : uint(findLSB(~bits)); }

uint bits_from(uint first) { return first >= 32u ? 0u : ~0u << first; }

// Halves tightened to the pixels in them; and the mask. A second look at the tile's pixels, for all threads together.
TileRanges refined_ranges(Frame frame, DepthImage depth_image, uvec2 tile, float z_near, float z_far) {
  TileRanges ranges = half_ranges(z_near, z_far);
  const uint threads = gl_WorkGroupSize.x * gl_WorkGroupSize.y;
  if (gl_LocalInvocationIndex == 0u) {
    s_near_half_max = 0u;
    s_far_half_min = ~0u;
    s_depth_mask = 0u;
  }
  barrier();  // initial values before the first reduction
  for (uint i = gl_LocalInvocationIndex; i < tile_samples(depth_image); i += threads) {
    const uint key = tile_sample_key(frame, depth_image, tile, i);
    const float z = z_view_of_key(frame, key);
    if (BOUNDS == BOUNDS_MASK)
      reduce_mask(key != SKY_KEY ? 1u << mask_part(z, z_near, mask_scale(z_near, z_far)) : 0u);
    else  // a half's farthest sample has its least key, so both extremes are kept inverted
      reduce_halves(key != SKY_KEY, z <= ranges.split, ~key);
  }
  barrier();  // every reduction before the results are read
  if (BOUNDS == BOUNDS_MASK) {
    ranges = one_range(z_near, z_far);
    ranges.mask = s_depth_mask;
    return ranges;
  }
  ranges.z_far[0] = s_near_half_max == 0u ? z_near : z_view_of_key(frame, ~s_near_half_max);
  ranges.z_near[1] = s_far_half_min == ~0u ? EMPTY_NEAR : z_view_of_key(frame, ~s_far_half_min);
  ranges.z_far[1] = s_far_half_min == ~0u ? EMPTY_FAR : z_far;
  ranges.split = split_between(ranges);
  return ranges;
}

// For all threads of the group together.
TileRanges tile_ranges(Frame frame, DepthImage depth_image, uvec2 tile) {
  if (BOUNDS == BOUNDS_NONE) return one_range(-ANY_DEPTH, ANY_DEPTH);  // the depth buffer is not looked at
  const TileDepth depth = tile_depth(frame, depth_image, tile);
  if (is_empty(depth)) return empty_ranges();
  const float z_near = z_view_of_key(frame, depth.nearest);
  const float z_far = z_view_of_key(frame, depth.farthest);
  if (BOUNDS == BOUNDS_MINMAX) return one_range(z_near, z_far);
  if (BOUNDS == BOUNDS_HALF) return half_ranges(z_near, z_far);
  return refined_ranges(frame, depth_image, tile, z_near, z_far);
}

#endif
