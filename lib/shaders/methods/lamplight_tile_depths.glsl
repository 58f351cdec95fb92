// Depths of the tiles of a cell, which is a work group's: nearest, farthest and the mask of occupied parts of each;
// nearest and farthest of all. A subgroup takes whole tiles, so that tiles need no barrier.
// Based on: Harada, A 2.5D Culling for Forward+, SIGGRAPH Asia (2012), for the mask.
// Needs: TILE_PX, CELL_TILES, HELD: 1 or MOST_HELD; BOUNDS_MASK; `frame`, `depth_squares` (DepthSquares).
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_TILE_DEPTHS
#define LAMP_METHODS_LAMPLIGHT_TILE_DEPTHS
#extension GL_EXT_control_flow_attributes : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "common/tile_ranges.glsl"

shared uint s_nearest;   // keys: the nearest depth's is the greatest
shared uint s_farthest;

// HELD squares of 2 x 2 pixels, or as many samples, are loaded at once by a thread and held in registers: with two, 32
// threads read a tile of 16 pixels once.
const uint MOST_HELD = 2u;

uvec4 keys_of(vec4 depths) { return uvec4(abs(ivec4(floatBitsToUint(depths)) - int(frame.sky_bits))); }

#ifdef MULTISAMPLED
uint squares_of_tile() { return tile_samples(depth_squares) / 4u; }

uvec4 square_keys(uvec2 tile, uint square) {
  uvec4 keys;
  for (uint i = 0u; i < 4u; ++i) keys[i] = tile_sample_key(frame, depth_squares, tile, 4u * square + i);
  return keys;
}
#else
const uint SQUARES_ACROSS = TILE_PX / 2u;
uint squares_of_tile() { return SQUARES_ACROSS * SQUARES_ACROSS; }

// The sky's beyond the picture, whatever a larger image holds there. Gathered are the four around the corner that they
// share, in the order of Vulkan: (0, 1), (1, 1), (1, 0), (0, 0).
uvec4 square_keys(uvec2 tile, uint square) {
  const uvec2 pixel = tile * TILE_PX + 2u * uvec2(square % SQUARES_ACROSS, square / SQUARES_ACROSS);
  const vec2 corner = vec2(pixel + frame.depth_offset_px + 1u);
  const uvec4 keys = keys_of(textureGather(depth_squares, corner / vec2(textureSize(depth_squares, 0))));
  const uvec4 x = pixel.x + uvec4(0u, 1u, 1u, 0u);
  const uvec4 y = pixel.y + uvec4(1u, 1u, 0u, 0u);
  const uvec4 in_rows = mix(uvec4(SKY_KEY), keys, lessThan(y, uvec4(frame.size_px.y)));
  return mix(uvec4(SKY_KEY), in_rows, lessThan(x, uvec4(frame.size_px.x)));
}
#endif

void load_keys(uvec2 tile, uint first, out uvec4 keys[MOST_HELD]) {
  const uint squares = squares_of_tile();
  [[unroll]] for (uint k = 0u; k < MOST_HELD; ++k) {
    const uint square = first + k * gl_SubgroupSize + gl_SubgroupInvocationID;
    const bool there = k < HELD && (squares % (HELD * gl_SubgroupSize) == 0u || square < squares);
    keys[k] = there ? square_keys(tile, square) : uvec4(SKY_KEY);
  }
}

// The mask's parts of keys. A faster division than that of z_view_of: off by a few units in the last place, which the
// slack of light bounds covers.
uvec4 parts_of_keys(mat4 clip, uvec4 keys, float z_near, float scale) {
  const vec4 depths = uintBitsToFloat(uvec4(abs(ivec4(keys) - int(frame.sky_bits))));
  const vec4 z = (clip[3][2] - clip[3][3] * depths) / (clip[2][2] - clip[2][3] * depths);
  return uvec4(clamp((z - z_near) * scale, 0.0, float(MASK_BITS - 1u)));
}

// For all threads of a subgroup together; every one of them returns the tile's ranges.
TileDepths depths_of_tile(uvec2 tile) {
  const uint stride = HELD * gl_SubgroupSize;
  const uint squares = squares_of_tile();
  uvec4 keys[MOST_HELD];
  uint nearest = SKY_KEY;
  uint farthest = ~0u;
  for (uint first = 0u; first < squares; first += stride) {
    load_keys(tile, first, keys);
    [[unroll]] for (uint k = 0u; k < MOST_HELD; ++k) {
      const uvec4 surfaces = mix(keys[k], uvec4(~0u), equal(keys[k], uvec4(SKY_KEY)));
      nearest = max(nearest, max(max(keys[k].x, keys[k].y), max(keys[k].z, keys[k].w)));
      farthest = min(farthest, min(min(surfaces.x, surfaces.y), min(surfaces.z, surfaces.w)));
    }
  }
  nearest = subgroupMax(nearest);
  farthest = subgroupMin(farthest);
  if (nearest == SKY_KEY) return TileDepths(EMPTY_NEAR, EMPTY_FAR, 0.0, 0u);
  if (subgroupElect()) {
    atomicMax(s_nearest, nearest);
    atomicMin(s_farthest, farthest);
  }
  const float z_near = z_view_of_key(frame, nearest);
  const float z_far = z_view_of_key(frame, farthest);
  const float scale = mask_scale(z_near, z_far);
  const mat4 clip = frame.clip_from_view;
  uint mask = 0u;
  for (uint first = 0u; first < squares; first += stride) {
    if (squares > stride) load_keys(tile, first, keys);
    [[unroll]] for (uint k = 0u; k < MOST_HELD; ++k) {
      const uvec4 parts = parts_of_keys(clip, keys[k], z_near, scale);
      [[unroll]] for (int i = 0; i < 4; ++i) mask |= keys[k][i] != SKY_KEY ? 1u << parts[i] : 0u;
    }
  }
  return TileDepths(z_near, z_far, scale, subgroupOr(mask));
}

// Depths that a half float holds no nearer, and no farther, however it is rounded: it has eleven bits, and a device may
// make zero of what is nearer to it than HALF_ZERO. Depths of an orthographic view may be negative, behind the eye.
float infinity() { return uintBitsToFloat(0x7f800000u); }
const float LARGEST_HALF = 65504.0;
const float HALF_ZERO = 6.2e-5;
float half_below(float z) {
  return z < -0.99 * LARGEST_HALF ? -infinity() : min((z > 0.0 ? 0.999 : 1.001) * z, LARGEST_HALF) - HALF_ZERO;
}
float half_above(float z) { return -half_below(-z); }

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
