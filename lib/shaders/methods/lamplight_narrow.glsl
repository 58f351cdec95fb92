// Needles: the bounding sphere of a narrow spot holds many times what the spot reaches. Where such a spot may have many
// cells it is held against each of them as a cone. And where cells lie.
// Needs: TILE_PX, CELL_TILES; `frame`, `lights`; SLICED and common/slice_constants.glsl, or `cell_depths`.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_NARROW
#define LAMP_METHODS_LAMPLIGHT_NARROW
#include "common/spot_tests.glsl"

const uint NARROW = 0x80000000u;   // in the light of a rectangle
const uint NARROW_CELLS = 16u;     // a light that may have fewer is not worth a look
const float NARROW_COSINE = 0.97;  // up to some 14 degrees
const float NARROW_RADIUS = 1e9;   // m; beyond, 32-bit numbers overflow

uint narrow_flag(uint light, float radius, uint cells) {
  if (cells < NARROW_CELLS || radius > NARROW_RADIUS) return 0u;
  return lights[light].type == LIGHT_SPOT && lights[light].cos_outer > NARROW_COSINE ? NARROW : 0u;
}

uvec2 cells_across() { return squares_across(frame, TILE_PX * CELL_TILES); }

// Metres ahead; of empty cells from infinity to minus infinity.
vec2 depths_of_cell(uint cell) {
#ifdef SLICED
  const uvec2 across = cells_across();
  const uint first = cell / (across.x * across.y) * CELL_SLICES;
  const float eye = from_eye(frame, -BEYOND_ALL_M);
  return vec2(max(slice_begin(first), eye), slice_end(first + CELL_SLICES - 1u));
#else
  return unpackHalf2x16(cell_depths[cell]);
#endif
}

bool cone_meets_cell(uint light, uint cell, vec2 depths) {
  const uvec2 across = cells_across();
  const uint in_layer = cell % (across.x * across.y);
  const uvec2 first = uvec2(in_layer % across.x, in_layer / across.x) * (TILE_PX * CELL_TILES);
  TileSides sides;
  tile_edges(frame, vec2(first), vec2(first + TILE_PX * CELL_TILES), sides.x_edges, sides.y_edges);
  return discs_touch_frustum(spot_cone(frame, lights[light]), sides, depths.x, depths.y);
}

#endif
