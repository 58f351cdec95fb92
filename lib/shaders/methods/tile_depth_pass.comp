// Depth ranges in a pass of their own: each thread takes four pixels, then a tree in shared memory.
// Based on: Stewart, Compute-Based Tiled Culling, GPU Pro 7 (2016), 1.4.4 and listing 1.5; Harris, Optimizing Parallel
// Reduction in CUDA (2007).
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x_id = 0, local_size_y_id = 0) in;  // half a tile
layout(constant_id = 1) const uint TILE_PX = 16;
layout(constant_id = 2) const uint BOUNDS = 0;
#include "common/tile_ranges.glsl"

layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 1) uniform texture2D depth_image;
layout(set = 0, binding = 2, scalar) writeonly buffer RangeBuffer { TileRanges ranges[]; };

// Two values a thread; the tree keeps the least of the first and the greatest of the second.
shared uint s_least[256];
shared uint s_greatest[256];

uvec2 reduce_tree(uint least, uint greatest) {
  const uint thread = gl_LocalInvocationIndex;
  barrier();  // an earlier tree's result is read before it is overwritten
  s_least[thread] = least;
  s_greatest[thread] = greatest;
  barrier();  // values before the first level
  for (uint step = gl_WorkGroupSize.x * gl_WorkGroupSize.y / 2u; step > 0u; step /= 2u) {
    if (thread < step) {
      s_least[thread] = min(s_least[thread], s_least[thread + step]);
      s_greatest[thread] = max(s_greatest[thread], s_greatest[thread + step]);
    }
    barrier();  // a level before the next
  }
  return uvec2(s_least[0], s_greatest[0]);
}

float pixel_depth(uint i) {
  const uvec2 pixel = gl_GlobalInvocationID.xy * 2u + uvec2(i & 1u, i >> 1);
  return any(greaterThanEqual(pixel, frame.size_px)) ? 0.0 : texelFetch(depth_image, ivec2(pixel), 0).x;
}

// The far end of the near half and the near end of the far half, as depths; reversed depth turns least and greatest.
TileRanges modified_half(float depths[4], TileRanges halves) {
  uint far_half_nearest = 0u;
  uint near_half_farthest = ~0u;
  for (uint i = 0u; i < 4u; ++i) {
    if (depths[i] <= 0.0) continue;
    const uint bits = floatBitsToUint(depths[i]);
    if (z_view_of(frame, depths[i]) <= halves.split)
      near_half_farthest = min(near_half_farthest, bits);
    else
      far_half_nearest = max(far_half_nearest, bits);
  }
  const uvec2 found = reduce_tree(near_half_farthest, far_half_nearest);
  halves.z_far[0] = z_view_of(frame, uintBitsToFloat(found.x));
  const bool far_half_empty = found.y == 0u;
  halves.z_near[1] = far_half_empty ? EMPTY_NEAR : z_view_of(frame, uintBitsToFloat(found.y));
  if (far_half_empty) halves.z_far[1] = EMPTY_FAR;
  return halves;
}

TileRanges masked(float depths[4], float z_near, float z_far) {
  if (gl_LocalInvocationIndex == 0u) s_depth_mask = 0u;
  barrier();  // cleared before bits are set
  uint bits = 0u;
  for (uint i = 0u; i < 4u; ++i)
    if (depths[i] > 0.0) bits |= 1u << mask_part(z_view_of(frame, depths[i]), z_near, mask_scale(z_near, z_far));
  reduce_mask(bits);
  barrier();  // all bits before they are read
  TileRanges result = one_range(z_near, z_far);
  result.mask = s_depth_mask;
  return result;
}

void main() {
  float depths[4];
  uint least = ~0u;
  uint greatest = 0u;
  for (uint i = 0u; i < 4u; ++i) {
    depths[i] = pixel_depth(i);
    if (depths[i] <= 0.0) continue;
    least = min(least, floatBitsToUint(depths[i]));
    greatest = max(greatest, floatBitsToUint(depths[i]));
  }
  const uvec2 found = reduce_tree(least, greatest);
  TileRanges result = empty_ranges();
  if (found.y != 0u) {
    const float z_near = z_view_of(frame, uintBitsToFloat(found.y));
    const float z_far = z_view_of(frame, uintBitsToFloat(found.x));
    if (BOUNDS == BOUNDS_MINMAX) result = one_range(z_near, z_far);
    if (BOUNDS == BOUNDS_HALF) result = half_ranges(z_near, z_far);
    if (BOUNDS == BOUNDS_MODIFIED_HALF) result = modified_half(depths, half_ranges(z_near, z_far));
    if (BOUNDS == BOUNDS_MASK) result = masked(depths, z_near, z_far);
  }
  if (gl_LocalInvocationIndex == 0u) ranges[gl_WorkGroupID.x + gl_NumWorkGroups.x * gl_WorkGroupID.y] = result;
}
