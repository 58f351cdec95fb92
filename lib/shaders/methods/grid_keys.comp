// Lays the grid around the lights, and gives each light the key that it is sorted by: its place on a space-filling curve
// through 32 x 32 x 32 parts of the grid. Lights that fill much of the grid come before all others, so that the words of
// bits of small ones are of small ones alone.
// Based on: Ikkala et al., Hierarchical Bitmask Implicit Grids, GRAPP (2024); the curve: Morton (1966).
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "common/frame.glsl"
#include "common/implicit_grid.glsl"
#include "common/ordered_float.glsl"
#include "lamplight/shared/light.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint SLICES = 8;
layout(constant_id = 1) const float EXTENT_M = 0.0;  // of the grid from the eye on, at most; 0: as far as lights reach
layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) readonly buffer SphereBuffer { LightSphere spheres[]; };
layout(set = 0, binding = 2, scalar) readonly buffer ExtentBuffer { uint extents[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer GridBuffer { ImplicitGrid grids[]; };
layout(set = 0, binding = 4, scalar) writeonly buffer KeyBuffer { uint keys[]; };

// m. Slices of a grid without width or of an endless one: what positions are multiplied by stays a normal number.
const float LEAST_SIDE = 1e-30;
const float GREATEST_SIDE = 3e38;

ImplicitGrid lay_grid() {
  ImplicitGrid grid = ImplicitGrid(vec3(0.0), 0u, vec3(1.0), 0u);
  for (uint axis = 0u; axis < 3u; ++axis) {
    if (extents[axis] == 0u) continue;  // no light of finite range
    float low = float_of_ordered(~extents[axis]);
    float high = float_of_ordered(extents[3u + axis]);
    if (EXTENT_M > 0.0) {
      low = clamp(frame.eye_world[axis] - EXTENT_M, low, high);
      high = clamp(frame.eye_world[axis] + EXTENT_M, low, high);
    }
    grid.low[axis] = low;
    grid.slices_a_metre[axis] = float(SLICES) / clamp(high - low, LEAST_SIDE, GREATEST_SIDE);
  }
  return grid;
}

uint curve_bits(uint slice) {
  const uint part = slice * (1u << GRID_CURVE_BITS) / SLICES;
  uint spread = 0u;
  for (uint bit = 0u; bit < GRID_CURVE_BITS; ++bit) spread |= (part >> bit & 1u) << 3u * bit;
  return spread;
}

uint key_of(ImplicitGrid grid, LightSphere sphere) {
  if (sphere.radius < 0.0) return (1u << GRID_KEY_BITS) - 1u;
  const vec3 slices = 2.0 * sphere.radius * grid.slices_a_metre;
  const bool is_large = max(slices.x, max(slices.y, slices.z)) * float(GRID_LARGE_SHARE) > float(SLICES);
  const uvec3 place = min(grid_slices(grid, sphere.center, SLICES), uvec3(SLICES - 1u));
  const uint curve = curve_bits(place.x) | curve_bits(place.y) << 1u | curve_bits(place.z) << 2u;
  return is_large ? curve : curve | 1u << 3u * GRID_CURVE_BITS;
}

void main() {
  const uint light = gl_GlobalInvocationID.x;
  const ImplicitGrid grid = lay_grid();
  if (light == 0u) grids[0] = grid;  // the same numbers for all: nobody divides again
  if (light < light_count_of(frame)) keys[light] = key_of(grid, spheres[light]);
}
