// Whether a light of a piece reaches a row of its cell: a first look, the exact test of spheres, the test of cones.
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

// The first look. Returns APART, TOUCHES or UNDECIDED.
uint look_at_pair(Pair pair) {
  const Target target = target_of(pair);
  return look_at_parts(target.sphere, target.sides, target.depths.z_near, target.step, target.depths.scale,
                       target.parts);
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
