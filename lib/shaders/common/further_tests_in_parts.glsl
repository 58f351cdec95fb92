// The further tests of a mask's occupied parts.
// Needs: as common/further_tests.glsl and common/mask_tests.glsl.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_FURTHER_TESTS_IN_PARTS
#define LAMP_COMMON_FURTHER_TESTS_IN_PARTS
#include "common/further_tests.glsl"
#include "common/mask_tests.glsl"

// `parts`: of `scale` parts a metre from z_mask on; `depths` are those that they span, which are seldom long: one sphere
// does for radial bounds.
bool passes_further_tests_in_parts(Frame frame, uint id, LightBounds sphere, vec4 x_edges, vec4 y_edges, vec2 depths,
                                   float z_mask, float scale, uint parts) {
  if (SHAPES) {
    const vec2 found = box_depths(frame, id, RECORD_OF(id), sphere, x_edges, y_edges, depths);
    if (found.x > found.y || parts_between(found, z_mask, scale, parts) == 0u) return false;
  }
  return !RADIAL || radial_reaches_part(frame, id, x_edges, y_edges, radial_depths(sphere, depths.x, depths.y));
}

#endif
