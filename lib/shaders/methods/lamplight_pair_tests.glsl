// Whether a light of a piece reaches a row of its cell: a first look, the exact test of spheres, the test of cones.
// Based on: one step of the minimisation in common/sphere_tests.glsl, for the first look.
// Promise: the first look decides a pair only as the exact test would.
// Needs: TILE_PX, CELL_TILES, ROWS, PAIRS; `frame`, `lights`; s_lights.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_PAIR_TESTS
#define LAMP_METHODS_LAMPLIGHT_PAIR_TESTS
#include "common/light_bounds.glsl"
#include "common/sphere_tests.glsl"
#include "common/spot_tests.glsl"
#include "methods/lamplight_pairs.glsl"
#include "methods/lamplight_rows.glsl"

shared LightBounds s_spheres[PIECE];  // of spots with the radius negated

// What the tests of a pair look at.
struct Target {
  LightBounds sphere;
  TileSides sides;
  TileDepths depths;
  float step;  // m, of one of the mask's parts
  uint parts;  // near the sphere
};

Target target_of(Pair pair) {
  Target target;
  target.sphere = LightBounds(s_spheres[pair.entry].center, abs(s_spheres[pair.entry].radius));
  target.sides.x_edges = s_x_edges[pair.row];
  target.sides.y_edges = s_y_edges[pair.row];
  target.depths = depths_in_reach(pair.row, target.sphere);
  target.step = (target.depths.z_far - target.depths.z_near) / float(MASK_BITS);
  target.parts = parts_near(target.sphere, target.depths.z_near, target.depths.scale, target.depths.mask);
  return target;
}

// The first look: that cross-section of the occupied depths which is nearest to the sphere's centre. It decides 79 to 98
// of 100 pairs with occupied parts at the sphere's depths.
const uint APART = 0u;
const uint TOUCHES = 1u;
const uint UNDECIDED = 2u;

uint look_at_pair(Pair pair) {
  const Target target = target_of(pair);
  if (target.parts == 0u) return APART;
  const vec2 depths = depths_of_parts(target.depths.z_near, target.step, target.parts);
  const float radius2 = target.sphere.radius * target.sphere.radius;
  const float z_center = -target.sphere.center.z;
  const float z = clamp(z_center, depths.x, depths.y);
  const Section section = section_at(target.sphere, target.sides, z);
  if (least_in(section, z, depths.x, depths.y) > radius2) return APART;
  const uint part = mask_part(z, target.depths.z_near, target.depths.scale);
  const bool is_occupied = z != z_center || (target.parts >> part & 1u) != 0u;  // both ends are
  return is_occupied && section.value <= radius2 ? TOUCHES : UNDECIDED;
}

bool sphere_reaches_row(Pair pair) {
  const Target target = target_of(pair);
  return sphere_touches_parts(target.sphere, target.sides, target.depths.z_near, target.step, target.parts);
}

bool cone_reaches_row(Pair pair) {
  const Target target = target_of(pair);
  return spot_touches_tile(frame, lights[s_lights[pair.entry]], target.sides, target.depths.z_near,
                           target.depths.z_far, target.parts);
}

#endif
