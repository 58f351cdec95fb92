// Which lights of a piece reach which rows of its cell: a bit matrix in shared memory. Each subgroup takes lights of
// its own, and no barrier of the group stands between them. A first look at all pairs of light and row drops most.
// Those that stay wait until there are enough for the exact test of spheres by all of the subgroup's threads, and what
// that leaves of spots waits again, for the test of cones.
// Needs: TILE_PX, CELL_TILES, ROWS, MARK_WORDS, PAIRS; `frame`, `lights`, `spheres`; s_lights; PRUNED or not.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_MARKS
#define LAMP_METHODS_LAMPLIGHT_MARKS
#include "common/light_bounds.glsl"
#include "common/sphere_tests.glsl"
#include "common/spot_tests.glsl"
#include "methods/lamplight_pairs.glsl"
#include "methods/lamplight_rows.glsl"

shared uint s_bits[MARK_WORDS];  // PIECE_WORDS for each of ROWS
shared LightBounds s_spheres[PIECE];

uint bit_word(uint row, uint word) { return row * PIECE_WORDS + word; }

// By all threads of the group together, before a barrier.
void clear_marks() {
  for (uint i = gl_LocalInvocationIndex; i < MARK_WORDS; i += gl_WorkGroupSize.x) s_bits[i] = 0u;
}

// What the exact tests look at.
struct Target {
  LightBounds sphere;
  TileSides sides;
  TileRanges ranges;
  uint parts;  // of the mask, near the sphere
};

Target target_of(Pair pair) {
  Target target;
  target.sphere = LightBounds(s_spheres[pair.entry].center, abs(s_spheres[pair.entry].radius));
  target.sides.x_edges = s_x_edges[pair.row];
  target.sides.y_edges = s_y_edges[pair.row];
  target.ranges = ranges_of_row(pair.row, target.sphere);
  target.parts = parts_near(target.sphere, target.ranges);
  return target;
}

bool sphere_reaches_row(Pair pair) {
  const Target target = target_of(pair);
  return sphere_touches_runs(target.sphere, target.sides, target.ranges, target.parts);
}

bool cone_reaches_row(Pair pair) {
  const Target target = target_of(pair);
  return spot_touches_tile(frame, lights[s_lights[pair.entry]], target.sides, target.ranges.z_near[0],
                           target.ranges.z_far[0], target.parts);
}

#ifdef PRUNED
#include "methods/lamplight_prune.glsl"
#endif

// All below is for the threads of a subgroup together.
// Its i-th light in the piece. Neighbours go to different subgroups, because they tend to have as many pairs.
uint entry_of(uint i) { return gl_SubgroupID + i * gl_NumSubgroups; }

void load_spheres(uint count) {
  for (uint i = gl_SubgroupInvocationID; i < count; i += gl_SubgroupSize) {
    const uint light = s_lights[entry_of(i)];
    s_spheres[entry_of(i)] = view_bounds(frame, spheres[light]);
    if (lights[light].type == LIGHT_SPOT) s_spheres[entry_of(i)].radius *= -1.0;  // a sign is all that a spot takes
  }
  subgroupMemoryBarrierShared();
  subgroupBarrier();  // spheres before other threads read them
}

void mark(Cell cell, Pair pair, bool reached) {
#ifdef PRUNED
  reached = keeps_pair(cell, pair, reached);
#endif
  if (reached) atomicOr(s_bits[bit_word(pair.row, pair.entry / 32u)], 1u << (pair.entry % 32u));
}

void test_spheres(Cell cell, inout uint pairs, inout uint spots) {
  bool has_pair;
  const uint packed = take(first_pair(), pairs, has_pair);
  const Pair pair = pair_of(packed);
  const bool reached = has_pair && sphere_reaches_row(pair);
  mark(cell, pair, reached && !pair.spot);
  spots = wait(first_spot(), spots, reached && pair.spot, packed);
}

void test_cones(Cell cell, inout uint spots) {
  bool has_pair;
  const Pair pair = pair_of(take(first_spot(), spots, has_pair));
  mark(cell, pair, has_pair && cone_reaches_row(pair));
}

// Lights [0, count) of the piece. One loop to the end, so that every test is in the code once.
void mark_lights(Cell cell, uint count) {
  const uint own = (count + gl_NumSubgroups - 1u - gl_SubgroupID) / gl_NumSubgroups;  // lights
  load_spheres(own);
  uint pairs = 0u;  // that wait
  uint spots = 0u;
  bool any_left = true;
  for (uint start = 0u; any_left; start += gl_SubgroupSize) {
    const uint i = start + gl_SubgroupInvocationID;
    const uint entry = entry_of(i / ROWS);
    const uint row = i % ROWS;
    bool near = false;
    uint spot = 0u;
    if (i < own * ROWS) {
      const LightBounds sphere = s_spheres[entry];
      spot = sphere.radius < 0.0 ? PAIR_OF_SPOT : 0u;
      near = may_reach_row(LightBounds(sphere.center, abs(sphere.radius)), row);
    }
    pairs = wait(first_pair(), pairs, near, packed_pair(entry, row, spot));
    any_left = start + gl_SubgroupSize < own * ROWS;
    const uint enough = any_left ? gl_SubgroupSize : 1u;
    if (pairs >= enough) test_spheres(cell, pairs, spots);
    while (spots >= enough) test_cones(cell, spots);
    any_left = any_left || pairs > 0u;
  }
}

#endif
