// Needles: the bounding sphere of a narrow spot holds many times what the spot reaches. Such spots are held against each cell
// as cones, once their hits wait to be written: there, registers are free that the walk needs.
// Needs: TILE_PX, CELL_TILES; `frame`, `lights`; SLICED and common/slice_constants.glsl, or `cell_depths`; s_hits of
// methods/lamplight_walk.glsl.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_NARROW
#define LAMP_METHODS_LAMPLIGHT_NARROW
#extension GL_KHR_shader_subgroup_ballot : require
#include "common/spot_tests.glsl"

const uint NARROW = 0x80000000u;    // in the light of a hit
const uint NARROW_CELLS = 8u;       // a light that may have fewer is not worth a look
const float NARROW_COSINE = 0.97;   // up to some 14 degrees
const float NARROW_RADIUS = 1e9;    // m; beyond, 32-bit numbers overflow

uint narrow_flag(uint light, float radius, uint cells) {
  if (cells < NARROW_CELLS || radius > NARROW_RADIUS) return 0u;
  return lights[light].type == LIGHT_SPOT && lights[light].cos_outer > NARROW_COSINE ? NARROW : 0u;
}

// Metres ahead.
vec2 depths_of_cell(uint cell, uint cells_in_layer) {
#ifdef SLICED
  const uint first = cell / cells_in_layer * CELL_SLICES;
  const float eye = is_perspective(frame) ? 0.0 : -BEYOND_ALL_M;
  return vec2(max(slice_begin(first), eye), slice_end(first + CELL_SLICES - 1u));
#else
  return unpackHalf2x16(cell_depths[cell]);
#endif
}

bool cone_meets_cell(uint light, uint cell) {
  const uvec2 across = cells_across();
  const uint in_layer = cell % (across.x * across.y);
  const uvec2 first = uvec2(in_layer % across.x, in_layer / across.x) * (TILE_PX * CELL_TILES);
  TileSides sides;
  tile_edges(frame, vec2(first), vec2(first + TILE_PX * CELL_TILES), sides.x_edges, sides.y_edges);
  const vec2 depths = depths_of_cell(cell, across.x * across.y);
  return discs_touch_frustum(spot_cone(frame, lights[light]), sides, depths.x, depths.y);
}

// For a subgroup together: drops waiting hits whose cones miss the cell, and the flags. Returns how many stay.
uint without_misses(uint waiting) {
  subgroupMemoryBarrierShared();
  subgroupBarrier();  // hits are there before they are read
  uint kept = 0u;
  for (uint start = 0u; start < waiting; start += gl_SubgroupSize) {
    const uint i = start + gl_SubgroupInvocationID;
    LightHit hit = s_hits[first_hit() + min(i, waiting - 1u)];
    bool keeps = i < waiting;
    if (keeps && (hit.light & NARROW) != 0u) {
      hit.light &= ~NARROW;
      keeps = cone_meets_cell(hit.light, hit.place);
    }
    const uvec4 those = subgroupBallot(keeps);
    subgroupBarrier();  // read before others take their place
    if (keeps) s_hits[first_hit() + kept + subgroupBallotExclusiveBitCount(those)] = hit;
    kept += subgroupBallotBitCount(those);
  }
  return kept;
}

#endif
