// One look at the depth buffer: each tile's depth range with a mask of its occupied parts, each cell's depth range.
// Based on: Harada, A 2.5D Culling for Forward+, SIGGRAPH Asia (2012), for the mask. A work group is a cell, a subgroup
// takes whole tiles, so that tiles need no barrier.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint TILE_PX = 16;
layout(constant_id = 2) const uint CELL_TILES = 4;
layout(constant_id = 3) const uint BLOCK = 256;  // lights
#define BOUNDS BOUNDS_MASK
#include "common/tile_ranges.glsl"
#include "lamplight/shared/lamplight.h"

layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frame; };
layout(set = 0, binding = 1) uniform texture2D depth_image;
layout(set = 0, binding = 2, scalar) writeonly buffer TileBuffer { TileDepths tile_depths[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer CellDepthBuffer { uint cell_depths[]; };  // half floats
layout(set = 0, binding = 4, scalar) writeonly buffer CountBuffer { uint counts[]; };  // [block][cell]

shared uint s_nearest;   // device depth: reversed, so the greatest
shared uint s_farthest;

// Depths that a thread loads at once and holds in registers: with 32 threads a tile of 16 pixels is read once.
const uint HELD = 8u;
const uint PIXELS = TILE_PX * TILE_PX;

void load_depths(uvec2 tile, uvec2 size_px, uint first, out float depths[HELD]) {
  const bool inside = all(lessThanEqual((tile + 1u) * TILE_PX, size_px)) && first + HELD * gl_SubgroupSize <= PIXELS;
  [[unroll]] for (uint k = 0u; k < HELD; ++k) {
    const uint i = first + k * gl_SubgroupSize + gl_SubgroupInvocationID;
    const uvec2 pixel = tile * TILE_PX + uvec2(i % TILE_PX, i / TILE_PX);
    if (inside)
      depths[k] = texelFetch(depth_image, ivec2(pixel), 0).x;
    else
      depths[k] = i < PIXELS ? tile_pixel_depth(frame, depth_image, tile, i) : 0.0;
  }
}

// The mask's part of a device depth. A faster division than that of z_view_of: off by a few units in the last place,
// which the slack of light bounds covers.
uint part_of_depth(mat4 clip, float depth, float z_near, float scale) {
  const float z = (clip[3][2] - clip[3][3] * depth) / (clip[2][2] - clip[2][3] * depth);
  return mask_part(z, z_near, scale);
}

// For all threads of a subgroup together; every one of them returns the tile's ranges.
TileDepths depths_of_tile(uvec2 tile, uvec2 size_px) {
  const uint stride = HELD * gl_SubgroupSize;
  float depths[HELD];
  uint nearest = 0u;
  uint farthest = ~0u;
  for (uint first = 0u; first < PIXELS; first += stride) {
    load_depths(tile, size_px, first, depths);
    [[unroll]] for (uint k = 0u; k < HELD; ++k) {
      const uint bits = floatBitsToUint(depths[k]);
      nearest = max(nearest, bits);
      farthest = min(farthest, bits == 0u ? ~0u : bits);
    }
  }
  nearest = subgroupMax(nearest);
  farthest = subgroupMin(farthest);
  if (nearest == 0u) return TileDepths(EMPTY_NEAR, EMPTY_FAR, 0u, 0u);
  if (subgroupElect()) {
    atomicMax(s_nearest, nearest);
    atomicMin(s_farthest, farthest);
  }
  const float z_near = z_view_of(frame, uintBitsToFloat(nearest));
  const float z_far = z_view_of(frame, uintBitsToFloat(farthest));
  const float scale = mask_scale(z_near, z_far);
  const mat4 clip = frame.clip_from_view;
  uint mask = 0u;
  for (uint first = 0u; first < PIXELS; first += stride) {
    if (PIXELS > stride) load_depths(tile, size_px, first, depths);
    [[unroll]] for (uint k = 0u; k < HELD; ++k)
      if (depths[k] > 0.0) mask |= 1u << part_of_depth(clip, depths[k], z_near, scale);
  }
  return TileDepths(z_near, z_far, subgroupOr(mask), 0u);
}

// Depths that a half float holds no nearer, and no farther, however it is rounded: it has eleven bits.
float infinity() { return uintBitsToFloat(0x7f800000u); }
const float LARGEST_HALF = 65504.0;
float half_below(float z) { return min(0.999 * z, LARGEST_HALF); }
float half_above(float z) { return z > 0.99 * LARGEST_HALF ? infinity() : 1.001 * z + 1e-6; }

// The count matrix, for the passes that follow: here it costs nothing, because all wait for the depth buffer.
void clear_counts() {
  const uint cells = gl_NumWorkGroups.x * gl_NumWorkGroups.y;
  const uint words = (frame.light_count + BLOCK - 1u) / BLOCK * cells;
  const uint group = gl_WorkGroupID.x + gl_NumWorkGroups.x * gl_WorkGroupID.y;
  for (uint i = group * gl_WorkGroupSize.x + gl_LocalInvocationIndex; i < words; i += cells * gl_WorkGroupSize.x)
    counts[i] = 0u;
}

void main() {
  if (gl_LocalInvocationIndex == 0u) {
    s_nearest = 0u;
    s_farthest = ~0u;
  }
  barrier();  // initial values before the first tile
  const uvec2 size_px = frame.size_px;
  const uvec2 tiles = (size_px + TILE_PX - 1u) / TILE_PX;
  for (uint i = gl_SubgroupID; i < CELL_TILES * CELL_TILES; i += gl_NumSubgroups) {
    const uvec2 tile = gl_WorkGroupID.xy * CELL_TILES + uvec2(i % CELL_TILES, i / CELL_TILES);
    if (any(greaterThanEqual(tile, tiles))) continue;
    const TileDepths result = depths_of_tile(tile, size_px);
    if (subgroupElect()) tile_depths[tile.x + tiles.x * tile.y] = result;
  }
  clear_counts();
  barrier();  // every tile before the cell is written
  if (gl_LocalInvocationIndex != 0u) return;
  vec2 depths = vec2(infinity(), -infinity());  // sky: no light reaches
  if (s_nearest != 0u) {
    depths.x = half_below(z_view_of(frame, uintBitsToFloat(s_nearest)));
    depths.y = half_above(z_view_of(frame, uintBitsToFloat(s_farthest)));
  }
  cell_depths[gl_WorkGroupID.x + gl_NumWorkGroups.x * gl_WorkGroupID.y] = packHalf2x16(depths);
}
