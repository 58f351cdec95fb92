// What follows a method's own test of a sphere: lights against their radial bounds, boxes by their shape.
// Needs: FURTHER, its FURTHER_* bits; RADIAL_BINDING; RECORD_OF(id), a light's record, which SHAPES alone reads.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_FURTHER_TESTS
#define LAMP_COMMON_FURTHER_TESTS
#include "common/box_tests.glsl"
#include "common/radial_bounds.glsl"
#include "lamplight/shared/further_tests.h"

const bool RADIAL = (FURTHER & FURTHER_RADIAL) != 0u;
const bool SHAPES = (FURTHER & FURTHER_SHAPES) != 0u;

// Whether it may be met between two depths of a tile with these edges.
bool passes_further_tests(Frame frame, uint id, LightBounds sphere, vec4 x_edges, vec4 y_edges, vec2 depths) {
  if (SHAPES && !box_reaches(frame, id, RECORD_OF(id), sphere, x_edges, y_edges, depths)) return false;
  return !RADIAL || radial_reaches(frame, id, x_edges, y_edges, radial_depths(sphere, depths.x, depths.y));
}

#endif
