// One look at the depth buffer: each tile's depth range with a mask of its occupied parts, each cell's depth range.
// SPDX-License-Identifier: Apache-2.0

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint TILE_PX = 16;
layout(constant_id = 2) const uint CELL_TILES = 4;
layout(constant_id = 3) const uint HELD = 2;  // 1 or MOST_HELD
#define BOUNDS BOUNDS_MASK
#include "common/tile_ranges.glsl"
#include "lamplight/shared/lamplight.h"

layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frame; };
layout(set = 0, binding = 1) uniform sampler2D depth_squares;
layout(set = 0, binding = 2, scalar) writeonly buffer TileBuffer { TileDepths tile_depths[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer CellBuffer { LightCell cells[]; };
#ifdef CELL_BITS
layout(set = 0, binding = 6, scalar) writeonly buffer TotalBuffer { uint totals[]; };  // LightTotals
#endif
#include "methods/lamplight_cell_clear.glsl"
#include "methods/lamplight_tile_depths.glsl"

// Before all passes that count: sooner than a pass of its own.
void clear_totals() {
#ifdef CELL_BITS
  if (gl_WorkGroupID.xy != uvec2(0u)) return;
  for (uint i = gl_LocalInvocationIndex; i < totals.length(); i += gl_WorkGroupSize.x) totals[i] = 0u;
#endif
}

void main() {
  if (gl_LocalInvocationIndex == 0u) clear_cell_depths();
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
