// A tile's depth bounds: the least and greatest key of a device depth of its pixels. Sky is left out.
// Based on: Stewart, Compute-Based Tiled Culling, GPU Pro 7 (2016), 1.3.1 (there on view-space depth; device depth
// keeps the bounds exact).
// Needs: TILE_PX; works with any work group. Includes the atomic reduction unless another came first.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_TILE_DEPTH
#define LAMP_COMMON_TILE_DEPTH
#include "common/depth_image.glsl"
#include "common/reduce_atomic.glsl"

// Keys; nearest is the sky's where the tile holds nothing else.
struct TileDepth {
  uint nearest;
  uint farthest;
};

bool is_empty(TileDepth depth) { return depth.nearest == SKY_KEY; }

// Samples of a tile: those of a pixel follow each other.
uint tile_samples(DepthImage depth_image) { return TILE_PX * TILE_PX * samples_of(depth_image); }

// The pixel of the tile's i-th sample.
uvec2 tile_pixel(DepthImage depth_image, uvec2 tile, uint i) {
  const uint pixel = i >> uint(findMSB(samples_of(depth_image)));  // which are a power of two
  return tile * TILE_PX + uvec2(pixel % TILE_PX, pixel / TILE_PX);
}

// The key of the tile's i-th sample; that of sky beyond the picture.
uint tile_sample_key(Frame frame, DepthImage depth_image, uvec2 tile, uint i) {
  return depth_key_at(frame, depth_image, tile_pixel(depth_image, tile, i), i & (samples_of(depth_image) - 1u));
}

// For all threads of the group together.
TileDepth tile_depth(Frame frame, DepthImage depth_image, uvec2 tile) {
  const uint threads = gl_WorkGroupSize.x * gl_WorkGroupSize.y;
  if (gl_LocalInvocationIndex == 0u) {
    s_depth_min = ~0u;
    s_depth_max = SKY_KEY;
  }
  barrier();  // initial values before the first reduction
  for (uint i = gl_LocalInvocationIndex; i < tile_samples(depth_image); i += threads) {
    const uint key = tile_sample_key(frame, depth_image, tile, i);
    reduce_depth(key != SKY_KEY, key);
  }
  barrier();  // every reduction before the result is read
  return TileDepth(s_depth_max, s_depth_min);
}

#endif
