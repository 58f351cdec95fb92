// One look at the depth buffer: each tile's depth range with a mask of its occupied parts, each cell's depth range.
// Based on: Harada, A 2.5D Culling for Forward+, SIGGRAPH Asia (2012), for the mask. A work group is a cell, a subgroup
// takes whole tiles, so that tiles need no barrier.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint TILE_PX = 16;
layout(constant_id = 2) const uint CELL_TILES = 4;
#define BOUNDS BOUNDS_MASK
#include "common/tile_ranges.glsl"

layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frame; };
layout(set = 0, binding = 1) uniform texture2D depth_image;
layout(set = 0, binding = 2, scalar) writeonly buffer RangeBuffer { TileRanges ranges[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer CellDepthBuffer { vec2 cell_depths[]; };

shared uint s_nearest;   // device depth: reversed, so the greatest
shared uint s_farthest;

// For all threads of a subgroup together; every one of them returns the tile's ranges.
TileRanges ranges_of_tile(uvec2 tile) {
  const uvec4 active_lanes = subgroupBallot(true);
  const uint rank = subgroupBallotExclusiveBitCount(active_lanes);
  const uint lanes = subgroupBallotBitCount(active_lanes);
  uint nearest = 0u;
  uint farthest = ~0u;
  for (uint i = rank; i < TILE_PX * TILE_PX; i += lanes) {
    const uint bits = floatBitsToUint(tile_pixel_depth(frame, depth_image, tile, i));
    nearest = max(nearest, bits);
    farthest = min(farthest, bits == 0u ? ~0u : bits);
  }
  nearest = subgroupMax(nearest);
  farthest = subgroupMin(farthest);
  if (nearest == 0u) return empty_ranges();
  if (rank == 0u) {
    atomicMax(s_nearest, nearest);
    atomicMin(s_farthest, farthest);
  }
  TileRanges result =
      one_range(z_view_of(frame, uintBitsToFloat(nearest)), z_view_of(frame, uintBitsToFloat(farthest)));
  uint mask = 0u;
  for (uint i = rank; i < TILE_PX * TILE_PX; i += lanes) {
    const float depth = tile_pixel_depth(frame, depth_image, tile, i);
    if (depth > 0.0) mask |= 1u << mask_part(z_view_of(frame, depth), result.z_near[0], result.z_far[0]);
  }
  result.mask = subgroupOr(mask);
  return result;
}

void main() {
  if (gl_LocalInvocationIndex == 0u) {
    s_nearest = 0u;
    s_farthest = ~0u;
  }
  barrier();  // initial values before the first tile
  const uvec2 tiles = (frame.size_px + TILE_PX - 1u) / TILE_PX;
  for (uint i = gl_SubgroupID; i < CELL_TILES * CELL_TILES; i += gl_NumSubgroups) {
    const uvec2 tile = gl_WorkGroupID.xy * CELL_TILES + uvec2(i % CELL_TILES, i / CELL_TILES);
    if (any(greaterThanEqual(tile, tiles))) continue;
    const TileRanges result = ranges_of_tile(tile);
    if (subgroupElect()) ranges[tile.x + tiles.x * tile.y] = result;
  }
  barrier();  // every tile before the cell is written
  if (gl_LocalInvocationIndex != 0u) return;
  const vec2 depths = s_nearest == 0u ? vec2(EMPTY_NEAR, EMPTY_FAR)
                                      : vec2(z_view_of(frame, uintBitsToFloat(s_nearest)),
                                             z_view_of(frame, uintBitsToFloat(s_farthest)));
  cell_depths[gl_WorkGroupID.x + gl_NumWorkGroups.x * gl_WorkGroupID.y] = depths;
}
