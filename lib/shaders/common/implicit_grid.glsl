// The slice of a coordinate, for lists and for look-ups, in GLSL and in HLSL.
// Promise: no coordinate has a lesser slice than a lesser coordinate, however large; both sides compute the same.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_IMPLICIT_GRID
#define LAMP_COMMON_IMPLICIT_GRID
#include "common/language.glsl"
#include "lamplight/shared/implicit_grid.h"

LAMP_CONST_FLOAT LARGEST_FINITE = 3.4028234e38f;

// A subtraction and a multiplication, which Vulkan rounds in one way and which both preserve order. Infinities that they
// overflow to are cut with the rest.
uint grid_slice(float coordinate, float low, float slices_a_metre, uint slices) {
  const bool is_finite = abs(coordinate) <= LARGEST_FINITE;
  if (!is_finite) return slices;
  precise const float at = (coordinate - low) * slices_a_metre;
  return uint(clamp(at, 0.0, float(slices - 1u)));
}

uvec3 grid_slices(ImplicitGrid grid, vec3 position, uint slices) {
  return uvec3(grid_slice(position.x, grid.low.x, grid.slices_a_metre.x, slices),
               grid_slice(position.y, grid.low.y, grid.slices_a_metre.y, slices),
               grid_slice(position.z, grid.low.z, grid.slices_a_metre.z, slices));
}

#endif
