// Which lights of a piece reach which rows of its cell: a bit matrix in shared memory. Each subgroup takes lights of
// its own, and no barrier of the group stands between them. A first look at all pairs of light and row decides most.
// Those that it leaves open wait until there are enough for the exact test of spheres by all of the subgroup's threads.
// Spots whose spheres reach wait as well, for the test of cones, and with further tests all others for these.
// Needs: FURTHER; TILE_PX, CELL_TILES, ROWS, MARK_WORDS, PAIRS, LIGHTS_MISS; `frame`, `lights`, `spheres`; s_lights;
// PRUNED or not.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_MARKS
#define LAMP_METHODS_LAMPLIGHT_MARKS
#include "methods/lamplight_kept.glsl"
#include "methods/lamplight_pair_tests.glsl"

shared uint s_bits[MARK_WORDS];  // PIECE_WORDS for each of ROWS

uint bit_word(uint row, uint word) { return row * PIECE_WORDS + word; }

// By all threads of the group together, before a barrier. A loop of constant length: of others compilers make versions.
void clear_marks() {
  for (uint first = 0u; first < MARK_WORDS; first += gl_WorkGroupSize.x)
    if (first + gl_LocalInvocationIndex < MARK_WORDS) s_bits[first + gl_LocalInvocationIndex] = 0u;
  if (gl_LocalInvocationIndex == 0u) s_kept_count = 0u;
}

#ifdef PRUNED
#include "methods/lamplight_prune.glsl"
#endif

// By all threads of the group together. Returns how many of the lights may reach its rows.
uint load_spheres(uint count) {
  for (uint i = gl_LocalInvocationIndex; i < count; i += gl_WorkGroupSize.x) {
    const uint light = s_lights[i];
    const bool is_spot = lights[light].type == LIGHT_SPOT;
    const LightBounds sphere = view_bounds(frame, spheres[light]);
    s_spheres[i] = LightBounds(sphere.center, is_spot ? -sphere.radius : sphere.radius);
    keep_entry(i, sphere);
  }
  barrier();  // spheres before other threads read them
  return kept_count(count);
}

// All below is for the threads of a subgroup together.
// Its i-th light in the piece. Neighbours go to different subgroups, because they tend to have as many pairs.
uint entry_of(uint i) { return kept_entry(gl_SubgroupID + i * gl_NumSubgroups); }

void mark(Cell cell, Pair pair, bool reached) {
#ifdef PRUNED
  reached = keeps_pair(cell, pair, reached);
#endif
  if (reached) atomicOr(s_bits[bit_word(pair.row, pair.entry / 32u)], 1u << (pair.entry % 32u));
}

// Pairs whose spheres reach: they are marked, or wait for tests of cones and further ones.
void keep_pairs(Cell cell, bool reached, uint packed, inout uint others) {
  const Pair pair = pair_of(packed);
  const bool waits = pair.spot || FURTHER != 0u;
  mark(cell, pair, reached && !waits);
  others = wait(first_other(), others, reached && waits, packed);
}

// Of all pairs of `count` lights and row, those from `first` on.
void look_at_pairs(Cell cell, uint first, uint count, inout uint pairs, inout uint others) {
  const uint i = first + gl_SubgroupInvocationID;
  const uint entry = entry_of(min(i, count * cell.rows - 1u) >> findMSB(cell.rows));
  const uint packed = packed_pair(entry, i & cell.rows - 1u, s_spheres[entry].radius < 0.0 ? PAIR_OF_SPOT : 0u);
  const uint found = look_at_pair(pair_of(packed));
  const uint verdict = i < count * cell.rows ? found : APART;
  pairs = wait(first_pair(), pairs, verdict == UNDECIDED, packed);
  keep_pairs(cell, verdict == TOUCHES, packed, others);
}

void test_spheres(Cell cell, inout uint pairs, inout uint others) {
  bool has_pair;
  const uint packed = take(first_pair(), 1u, pairs, has_pair);
  keep_pairs(cell, has_pair && sphere_reaches_row(pair_of(packed)), packed, others);
}

void test_others(Cell cell, inout uint others) {
  const uint share = sharers(others);
  const uint rank = gl_SubgroupInvocationID & share - 1u;
  bool has_pair;
  const Pair pair = pair_of(take(first_other(), share, others, has_pair));
  bool reached = any_sharer(has_pair && (!pair.spot || cone_reaches_row(pair, rank, share)), share);
  reached = reached && rank == 0u;
  if (FURTHER != 0u) reached = reached && passes_further_tests_in_row(pair);
  mark(cell, pair, reached);
}

// By all threads of the group together: lights [0, count) of the piece. Each subgroup looks until no more pairs have
// room, then tests with every thread busy, until nothing is left. So every test is in the code once. Each has a loop of
// its own, because some devices go through all of a loop's body for the threads that need a part of it.
void mark_lights(Cell cell, uint entries) {
  const uint count = load_spheres(entries);
  const uint own = (count + gl_NumSubgroups - 1u - gl_SubgroupID) / gl_NumSubgroups;  // lights
  const uint all = own * cell.rows;
  uint first = 0u;  // pair of light and row not looked at
  uint pairs = 0u;  // that wait
  uint others = 0u;
  while (first < all || pairs > 0u || others > 0u) {
    for (; first < all && has_room(pairs) && has_room(others); first += gl_SubgroupSize)
      look_at_pairs(cell, first, own, pairs, others);
    const uint enough_pairs = first < all ? gl_SubgroupSize : 1u;
    while (pairs >= enough_pairs && has_room(others)) test_spheres(cell, pairs, others);
    const uint enough_others = first < all || pairs > 0u ? gl_SubgroupSize : 1u;
    while (others >= enough_others) test_others(cell, others);
  }
}

#endif
