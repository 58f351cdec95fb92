// One look at the depth buffer: each tile's depth range with a mask of its occupied parts, each cell's depth range. And
// zeroes for what later passes count or keep lights in.
// SPDX-License-Identifier: Apache-2.0
layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint TILE_PX = 16;
layout(constant_id = 2) const uint CELL_TILES = 4;
layout(constant_id = 3) const uint HELD = 2;     // up to MOST_HELD
layout(constant_id = 4) const uint BLOCK = 256;  // lights
layout(constant_id = 5) const uint SAMPLES = 1;  // a pixel
#define BOUNDS BOUNDS_MASK
#include "common/tile_ranges.glsl"
#include "lamplight/shared/lamplight.h"

layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 1) uniform DepthSquares depth_squares;
layout(set = 0, binding = 2, scalar) writeonly buffer TileBuffer { TileDepths tile_depths[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer CellBuffer { LightCell cells[]; };
layout(set = 0, binding = 4, scalar) writeonly buffer CountBuffer { uint counts[]; };  // blocks times cells, or bits
layout(set = 0, binding = 5, scalar) writeonly buffer CellDepthBuffer { uint cell_depths[]; };  // half floats
#ifdef CELL_BITS
layout(set = 0, binding = 6, scalar) writeonly buffer TotalBuffer { uint totals[]; };  // LightTotals
#endif
#include "methods/lamplight_tile_depths.glsl"

// Before all passes that count: sooner than a pass of its own.
void clear_totals() {
#ifdef CELL_BITS
  if (gl_WorkGroupID.xy != uvec2(0u)) return;
  for (uint i = gl_LocalInvocationIndex; i < totals.length(); i += gl_WorkGroupSize.x) totals[i] = 0u;
#endif
}

// A share of the zeroes, by all threads of the group together: here they cost little, because all wait for the depth
// buffer.
void clear_counts() {
  const uint cells = gl_NumWorkGroups.x * gl_NumWorkGroups.y;
  const uint words = (light_count_of(frame) + BLOCK - 1u) / BLOCK * cells;
  const uint group = gl_WorkGroupID.x + gl_NumWorkGroups.x * gl_WorkGroupID.y;
  for (uint i = group * gl_WorkGroupSize.x + gl_LocalInvocationIndex; i < words; i += cells * gl_WorkGroupSize.x)
    counts[i] = 0u;
}

void main() {
  if (gl_LocalInvocationIndex == 0u) clear_cell_depths();
  clear_totals();
  clear_counts();
  barrier();  // initial values before the first tile
  const uvec2 tiles = squares_across(frame, TILE_PX);
  for (uint i = gl_SubgroupID; i < CELL_TILES * CELL_TILES; i += gl_NumSubgroups) {
    const uvec2 tile = gl_WorkGroupID.xy * CELL_TILES + uvec2(i % CELL_TILES, i / CELL_TILES);
    if (any(greaterThanEqual(tile, tiles))) continue;
    const TileDepths result = depths_of_tile(tile);
    if (subgroupElect()) tile_depths[tile.x + tiles.x * tile.y] = result;
  }
  barrier();  // every tile before the cell
  if (gl_LocalInvocationIndex != 0u) return;
  const uint cell = gl_WorkGroupID.x + gl_NumWorkGroups.x * gl_WorkGroupID.y;
  cell_depths[cell] = packHalf2x16(depths_of_cell());
  cells[cell] = LightCell(0u, 0u, 0u);
}
