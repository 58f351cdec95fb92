// The further tests of pairs of light and row, after all others: marks of those that fail are taken back. As with spheres
// and cones, pairs wait until there is one for each thread of a subgroup; where fewer are left, threads share them.
// Needs: as lamplight_marks.glsl.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_CUT
#define LAMP_METHODS_LAMPLIGHT_CUT
#include "methods/lamplight_marks.glsl"

// All below is for the threads of a subgroup together.
void cut_pairs(inout uint waiting) {
  const uint share = sharers(waiting);
  const uint rank = gl_SubgroupInvocationID & share - 1u;
  bool has_pair;
  const Pair pair = pair_of(take(first_pair(), share, waiting, has_pair));
  const bool passes = any_sharer(has_pair && passes_in_row(pair, rank, share), share);
  if (has_pair && rank == 0u && !passes)
    atomicAnd(s_bits[bit_word(pair.row, pair.entry / 32u)], ~(1u << (pair.entry % 32u)));
}

// By all threads of the group together, between barriers: of lights [0, count) of the piece.
void cut_marks(Cell cell, uint count) {
  const uint all = count * cell.rows;
  uint waiting = 0u;
  for (uint first = gl_SubgroupID * gl_SubgroupSize; first < all; first += gl_NumSubgroups * gl_SubgroupSize) {
    const uint i = min(first + gl_SubgroupInvocationID, all - 1u);
    const uint entry = i >> findMSB(cell.rows);
    const uint row = i & cell.rows - 1u;
    const bool is_marked = (s_bits[bit_word(row, entry / 32u)] >> (entry % 32u) & 1u) != 0u;
    waiting = wait(first_pair(), waiting, first + gl_SubgroupInvocationID < all && is_marked, packed_pair(entry, row, 0u));
    while (waiting >= gl_SubgroupSize) cut_pairs(waiting);
  }
  while (waiting > 0u) cut_pairs(waiting);
}

// By all threads of the group together: marks of `count` lights, by all tests, are there for all threads.
void test_lights(Cell cell, uint count) {
  mark_lights(cell, count);
  barrier();  // all bits before they are read
  if (FURTHER != 0u) {
    cut_marks(cell, count);
    barrier();  // what is cut before bits are written
  }
}

#endif
