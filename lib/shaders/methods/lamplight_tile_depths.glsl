// Depths of the tiles of a cell, which is a work group's: nearest, farthest and the mask of occupied parts of each;
// nearest and farthest of all. A subgroup takes whole tiles, so that tiles need no barrier.
// Based on: Harada, A 2.5D Culling for Forward+, SIGGRAPH Asia (2012), for the mask.
// Needs: TILE_PX, CELL_TILES, SAMPLES, HELD: up to MOST_HELD; BOUNDS_MASK; `frame`, `depth_squares` (DepthSquares).
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_TILE_DEPTHS
#define LAMP_METHODS_LAMPLIGHT_TILE_DEPTHS
#extension GL_EXT_control_flow_attributes : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "common/half_range.glsl"
#include "common/tile_ranges.glsl"

shared uint s_nearest;   // keys: the nearest depth's is the greatest
shared uint s_farthest;

// HELD squares of 2 x 2 pixels, or as many samples, are loaded at once by a thread and held in registers: with two, 32
// threads read a tile of 16 pixels once, with eight one of four samples.
const uint MOST_HELD = 8u;

#ifdef MULTISAMPLED
uint squares_of_tile() { return TILE_PX * TILE_PX * SAMPLES / 4u; }

// Device depths. Beyond the picture those of its last pixels, which the tile has as well.
vec4 square_depths(uvec2 tile, uint square, bool inside) {
  vec4 depths;
  [[unroll]] for (uint i = 0u; i < 4u; ++i) {
    const uint pixel = (4u * square + i) / SAMPLES;
    uvec2 at = tile * TILE_PX + uvec2(pixel % TILE_PX, pixel / TILE_PX);
    if (!inside) at = min(at, frame.size_px - 1u);
    depths[i] = texelFetch(depth_squares, ivec2(at + frame.depth_offset_px), int((4u * square + i) % SAMPLES)).x;
  }
  return depths;
}
#else
const uint SQUARES_ACROSS = TILE_PX / 2u;
uint squares_of_tile() { return SQUARES_ACROSS * SQUARES_ACROSS; }

// Device depths; the sky's beyond the picture, whatever a larger image holds there. Gathered are the four around the
// corner that they share, in the order of Vulkan: (0, 1), (1, 1), (1, 0), (0, 0).
vec4 square_depths(uvec2 tile, uint square, bool inside) {
  const uvec2 pixel = tile * TILE_PX + 2u * uvec2(square % SQUARES_ACROSS, square / SQUARES_ACROSS);
  const vec2 corner = vec2(pixel + frame.depth_offset_px + 1u);
  const vec4 depths = textureGather(depth_squares, corner / vec2(textureSize(depth_squares, 0)));
  if (inside) return depths;
  const vec4 sky = vec4(uintBitsToFloat(frame.sky_bits));
  const uvec4 x = pixel.x + uvec4(0u, 1u, 1u, 0u);
  const uvec4 y = pixel.y + uvec4(1u, 1u, 0u, 0u);
  return mix(sky, mix(sky, depths, lessThan(y, uvec4(frame.size_px.y))), lessThan(x, uvec4(frame.size_px.x)));
}
#endif

void load_depths(uvec2 tile, uint first, bool inside, out vec4 depths[MOST_HELD]) {
  const uint squares = squares_of_tile();
  [[unroll]] for (uint k = 0u; k < MOST_HELD; ++k) {
    const uint square = first + k * gl_SubgroupSize + gl_SubgroupInvocationID;
    const bool there = k < HELD && (squares % (HELD * gl_SubgroupSize) == 0u || square < squares);
    depths[k] = there ? square_depths(tile, square, inside) : vec4(uintBitsToFloat(frame.sky_bits));
  }
}

struct NearFar {
  uint nearest;   // the greatest key
  uint farthest;  // the least key of a surface, less 1, so that the sky's is the greatest
};

// Depths are between 0 and 1: depth_key takes one multiplication of whole numbers.
void take_depths(vec4 depths, inout NearFar range) {
  const uint sign = frame.sky_bits == 0u ? 1u : ~0u;
  const uvec4 keys = floatBitsToUint(depths) * sign + frame.sky_bits;
  const uvec4 less = keys - 1u;
  range.nearest = max(range.nearest, max(max(keys.x, keys.y), max(keys.z, keys.w)));
  range.farthest = min(range.farthest, min(min(less.x, less.y), min(less.z, less.w)));
}

// Where between the nearest surface, 0, and the farthest, 1, a device depth lies, as a quotient of two linear functions:
// off by a few units in the last place of z, which the slack of light bounds covers.
struct Along {
  vec2 above;  // above.x + above.y * depth
  vec2 below;
};

Along along_tile(float z_near, float scale) {
  const float MOST_SCALE = 1e25;  // 1/m: of a tile that has one depth, 0, without leaving the range of numbers
  const mat4 m = frame.clip_from_view;
  const vec2 above = vec2(m[3][2] - z_near * m[2][2], z_near * m[2][3] - m[3][3]);
  return Along(above * min(scale / float(MASK_BITS), MOST_SCALE), vec2(m[2][2], -m[2][3]));
}

// A bit for each part of the mask with a depth. The sky is where the farthest surface is, or the nearest.
uint parts_of_depths(Along along, vec4 depths) {
  const float PARTS = 31.999998;  // one unit in the last place less than there are, so that 1 is in the last one
  const vec4 at = clamp((along.above.x + along.above.y * depths) / (along.below.x + along.below.y * depths), 0.0, 1.0);
  const uvec4 parts = uvec4(at * PARTS);
  return 1u << parts.x | 1u << parts.y | 1u << parts.z | 1u << parts.w;
}

// For all threads of a subgroup together; every one of them returns the tile's ranges.
TileDepths depths_of_tile(uvec2 tile) {
  const bool inside = all(lessThanEqual((tile + 1u) * TILE_PX, frame.size_px));
  const uint stride = HELD * gl_SubgroupSize;
  const uint squares = squares_of_tile();
  vec4 depths[MOST_HELD];
  NearFar range = NearFar(SKY_KEY, ~0u);
  for (uint first = 0u; first < squares; first += stride) {
    load_depths(tile, first, inside, depths);
    [[unroll]] for (uint k = 0u; k < MOST_HELD; ++k)
      if (k < HELD) take_depths(depths[k], range);
  }
  const uint nearest = subgroupMax(range.nearest);
  const uint farthest = subgroupMin(range.farthest) + 1u;
  if (nearest == SKY_KEY) return TileDepths(EMPTY_NEAR, EMPTY_FAR, 0.0, 0u);
  if (subgroupElect()) {
    atomicMax(s_nearest, nearest);
    atomicMin(s_farthest, farthest);
  }
  const float z_near = z_view_of_key(frame, nearest);
  const float z_far = z_view_of_key(frame, farthest);
  const float scale = mask_scale(z_near, z_far);
  const Along along = along_tile(z_near, scale);
  uint mask = 1u;  // the nearest surface's
  for (uint first = 0u; first < squares; first += stride) {
    if (squares > stride) load_depths(tile, first, inside, depths);
    [[unroll]] for (uint k = 0u; k < MOST_HELD; ++k)
      if (k < HELD) mask |= parts_of_depths(along, depths[k]);
  }
  return TileDepths(z_near, z_far, scale, subgroupOr(mask));
}

// Of the cell, once all of its tiles are known.
vec2 depths_of_cell() {
  if (s_nearest == SKY_KEY) return vec2(infinity(), -infinity());  // sky: no light reaches
  return vec2(half_below(z_view_of_key(frame, s_nearest)),
              half_above(z_view_of_key(frame, s_farthest)));
}

// By one thread, before a barrier.
void clear_cell_depths() {
  s_nearest = SKY_KEY;
  s_farthest = ~0u;
}

#endif
