// A tile's depth bounds: the least and greatest device depth of its pixels. Sky is left out.
// Based on: Stewart, Compute-Based Tiled Culling, GPU Pro 7 (2016), 1.3.1 (there on view-space depth; device depth
// keeps the bounds exact, and the order is the same but reversed).
// Needs: TILE_PX; works with any work group. Includes the atomic reduction unless another came first.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_TILE_DEPTH
#define LAMP_COMMON_TILE_DEPTH
#extension GL_EXT_samplerless_texture_functions : require
#include "common/frame.glsl"
#include "common/reduce_atomic.glsl"

// Device depths; nearest is 0 where the tile holds nothing but sky.
struct TileDepth {
  float nearest;
  float farthest;
};

bool is_empty(TileDepth depth) { return depth.nearest == 0.0; }

// Device depth of the tile's i-th pixel; 0 for sky and beyond the picture.
float tile_pixel_depth(Frame frame, texture2D depth_image, uvec2 tile, uint i) {
  const uvec2 pixel = tile * TILE_PX + uvec2(i % TILE_PX, i / TILE_PX);
  if (any(greaterThanEqual(pixel, frame.size_px))) return 0.0;
  return texelFetch(depth_image, ivec2(pixel), 0).x;
}

// For all threads of the group together. Non-negative floats sort like their bits.
TileDepth tile_depth(Frame frame, texture2D depth_image, uvec2 tile) {
  const uint threads = gl_WorkGroupSize.x * gl_WorkGroupSize.y;
  if (gl_LocalInvocationIndex == 0u) {
    s_depth_min = floatBitsToUint(1.0);
    s_depth_max = 0u;
  }
  barrier();  // initial values before the first reduction
  for (uint i = gl_LocalInvocationIndex; i < TILE_PX * TILE_PX; i += threads) {
    const float depth = tile_pixel_depth(frame, depth_image, tile, i);
    reduce_depth(depth > 0.0, floatBitsToUint(depth));
  }
  barrier();  // every reduction before the result is read
  return TileDepth(uintBitsToFloat(s_depth_max), uintBitsToFloat(s_depth_min));
}

#endif
