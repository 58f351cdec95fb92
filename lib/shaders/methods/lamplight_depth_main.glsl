// One look at the depth buffer: each tile's depth range with a mask of its occupied parts, each cell's depth range.
// Based on: Harada, A 2.5D Culling for Forward+, SIGGRAPH Asia (2012), for the mask. A work group is a cell, a subgroup
// takes whole tiles, so that tiles need no barrier.
// SPDX-License-Identifier: Apache-2.0
#extension GL_EXT_control_flow_attributes : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint TILE_PX = 16;
layout(constant_id = 2) const uint CELL_TILES = 4;
layout(constant_id = 3) const uint HELD = 2;  // 1 or MOST_HELD
#define BOUNDS BOUNDS_MASK
#include "common/tile_ranges.glsl"
#include "lamplight/shared/lamplight.h"

layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frame; };
layout(set = 0, binding = 1) uniform sampler2D depth_image;
layout(set = 0, binding = 2, scalar) writeonly buffer TileBuffer { TileDepths tile_depths[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer CellBuffer { LightCell cells[]; };
#ifdef CELL_BITS
layout(set = 0, binding = 6, scalar) writeonly buffer TotalBuffer { uint totals[]; };  // LightTotals
#endif
#ifdef GATHERS
#include "methods/lamplight_cell_gather.glsl"
#else
#include "methods/lamplight_cell_clear.glsl"
#endif

shared uint s_nearest;   // device depth: reversed, so the greatest
shared uint s_farthest;

// HELD squares of 2 x 2 pixels are loaded at once by a thread and held in registers: with two, 32 threads read a tile of 16
// pixels once.
const uint MOST_HELD = 2u;
const uint SQUARES_ACROSS = TILE_PX / 2u;
const uint SQUARES = SQUARES_ACROSS * SQUARES_ACROSS;

// Beyond the picture its edge again, which is of the same tile.
vec4 square_depths(uvec2 tile, uint square) {
  const uvec2 pixel = tile * TILE_PX + 2u * uvec2(square % SQUARES_ACROSS, square / SQUARES_ACROSS);
  return textureGather(depth_image, vec2(pixel + 1u) / vec2(frame.size_px));  // around the corner that they share
}

void load_depths(uvec2 tile, uint first, out vec4 depths[MOST_HELD]) {
  [[unroll]] for (uint k = 0u; k < MOST_HELD; ++k) {
    const uint square = first + k * gl_SubgroupSize + gl_SubgroupInvocationID;
    const bool there = k < HELD && (SQUARES % (HELD * gl_SubgroupSize) == 0u || square < SQUARES);
    depths[k] = there ? square_depths(tile, square) : vec4(0.0);
  }
}

// The mask's parts of device depths. A faster division than that of z_view_of: off by a few units in the last place,
// which the slack of light bounds covers.
uvec4 parts_of_depths(mat4 clip, vec4 depths, float z_near, float scale) {
  const vec4 z = (clip[3][2] - clip[3][3] * depths) / (clip[2][2] - clip[2][3] * depths);
  return uvec4(clamp((z - z_near) * scale, 0.0, float(MASK_BITS - 1u)));
}

// For all threads of a subgroup together; every one of them returns the tile's ranges.
TileDepths depths_of_tile(uvec2 tile) {
  const uint stride = HELD * gl_SubgroupSize;
  vec4 depths[MOST_HELD];
  uint nearest = 0u;
  uint farthest = ~0u;
  for (uint first = 0u; first < SQUARES; first += stride) {
    load_depths(tile, first, depths);
    [[unroll]] for (uint k = 0u; k < MOST_HELD; ++k) {
      const uvec4 bits = floatBitsToUint(depths[k]);
      const uvec4 surfaces = mix(bits, uvec4(~0u), equal(bits, uvec4(0u)));  // not sky
      nearest = max(nearest, max(max(bits.x, bits.y), max(bits.z, bits.w)));
      farthest = min(farthest, min(min(surfaces.x, surfaces.y), min(surfaces.z, surfaces.w)));
    }
  }
  nearest = subgroupMax(nearest);
  farthest = subgroupMin(farthest);
  if (nearest == 0u) return TileDepths(EMPTY_NEAR, EMPTY_FAR, 0.0, 0u);
  if (subgroupElect()) {
    atomicMax(s_nearest, nearest);
    atomicMin(s_farthest, farthest);
  }
  const float z_near = z_view_of(frame, uintBitsToFloat(nearest));
  const float z_far = z_view_of(frame, uintBitsToFloat(farthest));
  const float scale = mask_scale(z_near, z_far);
  const mat4 clip = frame.clip_from_view;
  uint mask = 0u;
  for (uint first = 0u; first < SQUARES; first += stride) {
    if (SQUARES > stride) load_depths(tile, first, depths);
    [[unroll]] for (uint k = 0u; k < MOST_HELD; ++k) {
      const uvec4 parts = parts_of_depths(clip, depths[k], z_near, scale);
      [[unroll]] for (int i = 0; i < 4; ++i) mask |= depths[k][i] > 0.0 ? 1u << parts[i] : 0u;
    }
  }
  return TileDepths(z_near, z_far, scale, subgroupOr(mask));
}

// Depths that a half float holds no nearer, and no farther, however it is rounded: it has eleven bits.
float infinity() { return uintBitsToFloat(0x7f800000u); }
const float LARGEST_HALF = 65504.0;
float half_below(float z) { return min(0.999 * z, LARGEST_HALF); }
float half_above(float z) { return z > 0.99 * LARGEST_HALF ? infinity() : 1.001 * z + 1e-6; }

// Of the cell, once all of its tiles are known.
vec2 depths_of_cell() {
  if (s_nearest == 0u) return vec2(infinity(), -infinity());  // sky: no light reaches
  return vec2(half_below(z_view_of(frame, uintBitsToFloat(s_nearest))),
              half_above(z_view_of(frame, uintBitsToFloat(s_farthest))));
}

// Before all passes that count: sooner than a pass of its own.
void clear_totals() {
#ifdef CELL_BITS
  if (gl_WorkGroupID.xy != uvec2(0u)) return;
  for (uint i = gl_LocalInvocationIndex; i < totals.length(); i += gl_WorkGroupSize.x) totals[i] = 0u;
#endif
}

void main() {
  if (gl_LocalInvocationIndex == 0u) {
    s_nearest = 0u;
    s_farthest = ~0u;
  }
  clear_totals();
  prepare_cell();
  barrier();  // initial values before the first tile
  const uvec2 size_px = frame.size_px;
  const uvec2 tiles = (size_px + TILE_PX - 1u) / TILE_PX;
  for (uint i = gl_SubgroupID; i < CELL_TILES * CELL_TILES; i += gl_NumSubgroups) {
    const uvec2 tile = gl_WorkGroupID.xy * CELL_TILES + uvec2(i % CELL_TILES, i / CELL_TILES);
    if (any(greaterThanEqual(tile, tiles))) continue;
    const TileDepths result = depths_of_tile(tile);
    if (subgroupElect()) tile_depths[tile.x + tiles.x * tile.y] = result;
  }
  barrier();  // every tile before the cell
  finish_cell(gl_WorkGroupID.x + gl_NumWorkGroups.x * gl_WorkGroupID.y, depths_of_cell());
}
