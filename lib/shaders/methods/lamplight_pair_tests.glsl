// Whether a light of a piece reaches a row of its cell: a first look, the exact test of spheres, the test of cones.
// Needs: FURTHER, RADIAL_BINDING; TILE_PX, CELL_TILES, ROWS, PAIRS; `frame`, `lights`; s_lights.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_PAIR_TESTS
#define LAMP_METHODS_LAMPLIGHT_PAIR_TESTS
#extension GL_EXT_control_flow_attributes : require
#include "common/light_bounds.glsl"
#include "common/sphere_tests.glsl"
#include "common/spot_tests.glsl"
#define RECORD_OF(id) lights[id]
#include "common/further_tests_in_parts.glsl"
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
  target.sides.x_edges = x_edges_of_row(pair.row);
  target.sides.y_edges = y_edges_of_row(pair.row);
  target.depths = depths_in_reach(pair.row, target.sphere);
  target.step = mask_step(target.depths.z_near, target.depths.z_far);
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

bool passes_further_tests_in_row(Pair pair) {
  const Target target = target_of(pair);
  if (target.parts == 0u) return false;
  return passes_further_tests_in_parts(
      frame, s_lights[pair.entry], target.sphere, target.sides.x_edges, target.sides.y_edges,
      depths_of_parts(target.depths.z_near, target.step, target.parts), target.depths.z_near, target.depths.scale,
      target.parts);
}

// What a thread looks at of a row's occupied parts: from the first to the last of them they are cut into quarters, of
// which `share` threads take every share-th each. Cuts are always there, so that the result is the same for any share.
struct PartShare {
  uint parts;
  uint borders;  // a bit behind each cut
};

PartShare share_of_parts(uint parts, uint rank, uint share) {
  const uint first = uint(findLSB(parts));
  const uint quarter = (uint(findMSB(parts)) - first) / MOST_SHARERS + 1u;
  PartShare own = PartShare(0u, 0u);
  [[unroll]] for (uint i = 0u; i < MOST_SHARERS; ++i) {
    const uint from = bits_from(first + i * quarter);
    const uint to = bits_from(first + (i + 1u) * quarter);
    if ((i & share - 1u) == rank) own.parts |= parts & from & ~to;
    own.borders |= to & ~(to << 1u);
  }
  return own;
}

bool cone_reaches_row(Pair pair, uint rank, uint share) {
  const Target target = target_of(pair);
  if (target.parts == 0u) return false;
  const PartShare own = share_of_parts(target.parts, rank, share);
  return spot_touches_tile(frame, lights[s_lights[pair.entry]], target.sides, target.depths.z_near,
                           target.depths.z_far, own.parts, own.borders);
}

#endif
