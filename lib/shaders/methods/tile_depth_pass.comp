// Depth ranges in a pass of their own: each thread takes four pixels, then a tree in shared memory.
// Based on: Stewart, Compute-Based Tiled Culling, GPU Pro 7 (2016), 1.4.4 and listing 1.5; Harris, Optimizing Parallel
// Reduction in CUDA (2007).
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "common/depth_image.glsl"

layout(local_size_x_id = 0, local_size_y_id = 0) in;  // half a tile
layout(constant_id = 1) const uint TILE_PX = 16;
layout(constant_id = 2) const uint BOUNDS = 0;
#include "common/tile_ranges.glsl"

layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 1) uniform DepthImage depth_image;
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

// A thread's samples, those of four pixels. One for each of them is held in registers; several are read again.
uint own_samples() { return 4u * samples_of(depth_image); }

uint read_key(uint i) {
  const uint pixel = i >> uint(findMSB(samples_of(depth_image)));  // which are a power of two
  return depth_key_at(frame, depth_image, gl_GlobalInvocationID.xy * 2u + uvec2(pixel & 1u, pixel >> 1),
                      i & (samples_of(depth_image) - 1u));
}

#ifdef MULTISAMPLED
void load_keys() {}
uint own_key(uint i) { return read_key(i); }
#else
uint keys[4];
void load_keys() {
  for (uint i = 0u; i < 4u; ++i) keys[i] = read_key(i);
}
uint own_key(uint i) { return keys[i]; }
#endif

// The far end of the near half and the near end of the far half.
TileRanges modified_half(TileRanges halves) {
  uint far_half_nearest = SKY_KEY;
  uint near_half_farthest = ~0u;
  for (uint i = 0u; i < own_samples(); ++i) {
    const uint key = own_key(i);
    if (key == SKY_KEY) continue;
    if (z_view_of_key(frame, key) <= halves.split)
      near_half_farthest = min(near_half_farthest, key);
    else
      far_half_nearest = max(far_half_nearest, key);
  }
  const uvec2 found = reduce_tree(near_half_farthest, far_half_nearest);
  halves.z_far[0] = found.x == ~0u ? halves.z_near[0] : z_view_of_key(frame, found.x);
  const bool far_half_empty = found.y == SKY_KEY;
  halves.z_near[1] = far_half_empty ? EMPTY_NEAR : z_view_of_key(frame, found.y);
  if (far_half_empty) halves.z_far[1] = EMPTY_FAR;
  halves.split = split_between(halves);
  return halves;
}

TileRanges masked(float z_near, float z_far) {
  if (gl_LocalInvocationIndex == 0u) s_depth_mask = 0u;
  barrier();  // cleared before bits are set
  uint bits = 0u;
  for (uint i = 0u; i < own_samples(); ++i) {
    const uint key = own_key(i);
    if (key != SKY_KEY) bits |= 1u << mask_part(z_view_of_key(frame, key), z_near, mask_scale(z_near, z_far));
  }
  reduce_mask(bits);
  barrier();  // all bits before they are read
  TileRanges result = one_range(z_near, z_far);
  result.mask = s_depth_mask;
  return result;
}

void main() {
  load_keys();
  uint least = ~0u;
  uint greatest = SKY_KEY;
  for (uint i = 0u; i < own_samples(); ++i) {
    const uint key = own_key(i);
    if (key == SKY_KEY) continue;
    least = min(least, key);
    greatest = max(greatest, key);
  }
  const uvec2 found = reduce_tree(least, greatest);
  TileRanges result = empty_ranges();
  if (found.y != SKY_KEY) {
    const float z_near = z_view_of_key(frame, found.y);
    const float z_far = z_view_of_key(frame, found.x);
    if (BOUNDS == BOUNDS_MINMAX) result = one_range(z_near, z_far);
    if (BOUNDS == BOUNDS_HALF) result = half_ranges(z_near, z_far);
    if (BOUNDS == BOUNDS_MODIFIED_HALF) result = modified_half(half_ranges(z_near, z_far));
    if (BOUNDS == BOUNDS_MASK) result = masked(z_near, z_far);
  }
  if (gl_LocalInvocationIndex == 0u) ranges[gl_WorkGroupID.x + gl_NumWorkGroups.x * gl_WorkGroupID.y] = result;
}
