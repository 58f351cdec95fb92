// A cell that looks at every light itself: while one piece holds them all, that is done sooner than lights find cells.
// Needs: TILE_PX, CELL_TILES; `frame`, `cells`. Gives prepare_cell, finish_cell.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_CELL_GATHER
#define LAMP_METHODS_LAMPLIGHT_CELL_GATHER
#include "common/light_bounds.glsl"
#include "common/tile_volume.glsl"
#include "common/volume_tests.glsl"

layout(set = 0, binding = 4, scalar) readonly buffer SphereBuffer { LightSphere spheres[]; };
layout(set = 0, binding = 5, scalar) writeonly buffer BitBuffer { uint cell_bits[]; };  // [cell][word]
layout(set = 0, binding = 7, scalar) writeonly buffer PieceBuffer { LightPiece cell_pieces[]; };

shared uint s_words[PIECE_WORDS];

// By all threads of the group together, before a barrier.
void prepare_cell() {
  if (gl_LocalInvocationIndex < PIECE_WORDS) s_words[gl_LocalInvocationIndex] = 0u;
}

void keep_lights_that_meet(vec2 depths) {
  const vec2 corner_px = vec2(gl_WorkGroupID.xy * TILE_PX * CELL_TILES);
  const vec2 end_px = min(corner_px + float(TILE_PX * CELL_TILES), vec2(frame.size_px));
  const RectangleEdges sides = rectangle_edges(frame, corner_px, end_px);
  for (uint light = gl_LocalInvocationIndex; light < frame.light_count; light += gl_WorkGroupSize.x) {
    const LightBounds sphere = view_bounds(frame, spheres[light]);
    if (sphere_touches_depths(sphere, depths.x, depths.y) && inside_edges(sphere.center, sphere.radius, sides))
      atomicOr(s_words[light / 32u], 1u << (light % 32u));
  }
}

// By all threads of the group together. The cell's lights are its one piece.
void finish_cell(uint cell, vec2 depths) {
  keep_lights_that_meet(depths);
  barrier();  // all lights before they are counted
  if (gl_LocalInvocationIndex != 0u) return;
  const uint words = (frame.light_count + 31u) / 32u;
  uint entries = 0u;
  for (uint i = 0u; i < words; ++i) {
    entries += uint(bitCount(s_words[i]));
    cell_bits[cell * words + i] = s_words[i];
  }
  cells[cell] = LightCell(cell, entries == 0u ? 0u : 1u, entries);
  cell_pieces[cell] = LightPiece(entries == 0u ? NO_CELL : cell, cell * PIECE, cell * PIECE + entries);
}

#endif
