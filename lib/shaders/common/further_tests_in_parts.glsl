// The further tests of a mask's occupied parts.
// Needs: as common/further_tests.glsl and common/mask_tests.glsl.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_FURTHER_TESTS_IN_PARTS
#define LAMP_COMMON_FURTHER_TESTS_IN_PARTS
#include "common/further_tests.glsl"
#include "common/mask_tests.glsl"

// `parts`: of `scale` parts a metre from z_mask on; `depths` are those that they span. Of a long way between these a
// thread has every share-th piece, from `rank` on: one thread's yes is the pair's.
bool passes_further_tests_in_parts(Frame frame, uint id, LightBounds sphere, vec4 x_edges, vec4 y_edges, vec2 depths,
                                   float z_mask, float scale, uint parts, uint rank, uint share) {
  if (SHAPES) {
    const vec2 found = box_depths(frame, id, RECORD_OF(id), sphere, x_edges, y_edges, depths);
    if (found.x > found.y || parts_between(found, z_mask, scale, parts) == 0u) return false;
  }
  if (!RADIAL || radial_cuts_nothing(id)) return true;
  const RadialPieces pieces = radial_pieces(frame, id, radial_depths(sphere, depths.x, depths.y));
  for (uint i = rank; i < pieces.count; i += share)
    if (parts_between(radial_piece(pieces, i), z_mask, scale, parts) != 0u &&
        radial_reaches_piece(id, pieces, i, x_edges, y_edges))
      return true;
  return false;
}

bool passes_further_tests_in_parts(Frame frame, uint id, LightBounds sphere, vec4 x_edges, vec4 y_edges, vec2 depths,
                                   float z_mask, float scale, uint parts) {
  return passes_further_tests_in_parts(frame, id, sphere, x_edges, y_edges, depths, z_mask, scale, parts, 0u, 1u);
}

#endif
