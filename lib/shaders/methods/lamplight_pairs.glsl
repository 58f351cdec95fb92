// Pairs of light and row that wait in shared memory, each subgroup's in a part of its own, until there is one for each
// of its threads.
// Needs: PAIRS, four for each thread of the group.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_PAIRS
#define LAMP_METHODS_LAMPLIGHT_PAIRS
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_shuffle : require

shared uint s_pairs[PAIRS];  // two of each thread for spheres, and behind all these two for other tests

// A light of the piece and a row, in 32 bits.
struct Pair {
  uint entry;
  uint row;
  bool spot;
};
const uint PAIR_ENTRY_BITS = 16u;
const uint PAIR_OF_SPOT = 0x80000000u;
uint packed_pair(uint entry, uint row, uint spot) { return entry | row << PAIR_ENTRY_BITS | spot; }
Pair pair_of(uint packed) {
  return Pair(packed & (1u << PAIR_ENTRY_BITS) - 1u, (packed & ~PAIR_OF_SPOT) >> PAIR_ENTRY_BITS,
              (packed & PAIR_OF_SPOT) != 0u);
}

// All below is for the threads of a subgroup together.
uint first_pair() { return gl_SubgroupID * 2u * gl_SubgroupSize; }
uint first_other() { return PAIRS / 2u + first_pair(); }

// For one more of each thread.
bool has_room(uint waiting) { return waiting <= gl_SubgroupSize; }

// Returns how many wait now, from `first` on.
uint wait(uint first, uint waiting, bool has_pair, uint packed) {
  const uvec4 those = subgroupBallot(has_pair);
  if (has_pair) s_pairs[first + waiting + subgroupBallotExclusiveBitCount(those)] = packed;
  return waiting + subgroupBallotBitCount(those);
}

const uint MOST_SHARERS = 4u;

// How many threads share a pair, if that many wait: fewer than there are threads leave some of these without work. A
// power of two.
uint sharers(uint waiting) {
  uint share = 1u;
  while (share < MOST_SHARERS && 2u * share * waiting <= gl_SubgroupSize) share *= 2u;
  return share;
}

// Whether one of the threads that share a pair says so.
bool any_sharer(bool says, uint share) {
  for (uint step = 1u; step < share; step *= 2u) {
    const bool other = subgroupShuffleXor(says, step);
    says = says || other;
  }
  return says;
}

// One of those that came last for `share` threads each; without one any of them again.
uint take(uint first, uint share, inout uint waiting, out bool has_pair) {
  subgroupMemoryBarrierShared();
  subgroupBarrier();  // pairs are there before they are read
  const uint count = min(waiting, gl_SubgroupSize);
  const uint own = gl_SubgroupInvocationID >> findMSB(share);
  has_pair = own < count;
  waiting -= count;
  const uint packed = s_pairs[first + waiting + min(own, count - 1u)];
  subgroupBarrier();  // and read before others take their place
  return packed;
}

#endif
