// Walks flat bit arrays with one light at a time for the whole subgroup: the words of its threads are merged, and a thread
// takes part in the lights that are its own. What is loaded for a light is then the same for all threads. Where most words
// are empty, the threads find out together which are not.
// Based on: Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017), "Scalarization".
// Promise: each thread meets exactly the lights of walk_next, in the same order, whichever threads are active with it.
// Needs: walk_bits.glsl, LOOKUP_WORDS of a cell. LOOKUP_SPARSE: where many words are asked for most are empty.
// SPDX-License-Identifier: Apache-2.0
#include "lookup/parts/subgroup.glsl"

LAMP_CONST LOOKUP_FEW_WORDS = 8u;  // are not worth a look
#ifdef LOOKUP_SPARSE
#define LOOKUP_LOOKS (LOOKUP_WORDS > LOOKUP_FEW_WORDS)
#else
#define LOOKUP_LOOKS false
#endif

struct WalkMerged {
  Walk own;
  uint word;      // the next word to look at
  uint end;       // of the words that some thread has
  uint block;     // with LOOKUP_LOOKS, bit i of `open` is word block + i
  uint open;      // words that may hold a light of some thread, not yet walked
  uint at;        // the word that is walked
  uint own_bits;  // of it
  uint bits;      // of it and all threads, not yet walked
  bool mine;      // the light is among the thread's own
};

WalkMerged walk_begin_merged(Walk own) {
  const bool any_bit = own.begin < own.end;
  WalkMerged walk;
  walk.own = own;
  walk.word = subgroupMin(any_bit ? own.begin / 32u : ~0u);
  walk.end = subgroupMax(any_bit ? (own.end + 31u) / 32u : 0u);
  walk.block = 0u;
  walk.open = 0u;
  walk.at = 0u;
  walk.own_bits = 0u;
  walk.bits = 0u;
  walk.mine = false;
  return walk;
}

LAMP_CONST LOOKUP_BLOCK_WORDS = 32u;

// Which of a block's words hold a light, of the cell whose words begin at `base`: every `step`-th from `first` on.
uint lookup_words_with_lights(uint base, uint block, uint count, uint first, uint step) {
  uint found = 0u;
  for (uint i = first; i < count; i += step)
    if (lookup_bits[base + block + i] != 0u) found |= 1u << i;
  return found;
}

// Most words are empty. Threads share out the words of a block, of every cell that some thread has, so that the subgroup
// sees in one step which of them to walk.
void lookup_at_words(inout WalkMerged walk) {
  walk.block = walk.word;
  const uint count = min(LOOKUP_BLOCK_WORDS, walk.end - walk.word);
  walk.word += count;
  walk.open = ~0u >> (32u - count);
  const uvec4 here = subgroupBallot(true);
  // Threads that have parted company and meet again at different words walk them all.
  const uvec2 words = uvec2(walk.block, walk.end);
  const bool differs = LAMP_DIFFER(words, subgroupBroadcastFirst(words));
  if (LAMP_DIFFER(subgroupBallot(!differs), here)) return;
  const uint step = max(subgroupBallotBitCount(here), 1u);  // 0 where all that are left cover no sample
  const uint first = subgroupBallotExclusiveBitCount(here);
  const uvec4 nobody = uvec4(0u, 0u, 0u, 0u);
  uint found = 0u;
  bool waits = walk.own.begin < walk.own.end;
  for (uvec4 waiting = subgroupBallot(waits); LAMP_DIFFER(waiting, nobody); waiting = subgroupBallot(waits)) {
    const uint base = subgroupMin(waits ? walk.own.base : ~0u);
    found |= lookup_words_with_lights(base, walk.block, count, first, step);
    waits = waits && walk.own.base != base;
  }
  walk.open = subgroupOr(found);
}

// The next word to walk; false if there is none.
bool lookup_next_open_word(inout WalkMerged walk) {
  if (!LOOKUP_LOOKS) {
    walk.at = walk.word++;
    return walk.at < walk.end;
  }
  while (walk.open == 0u) {
    if (walk.word >= walk.end) return false;
    lookup_at_words(walk);
  }
  walk.at = walk.block + LAMP_FIRST_BIT(walk.open);
  walk.open &= walk.open - 1u;
  return true;
}

// A thread's own bits are always among the merged ones, so threads that have parted company lose nothing.
bool walk_next_merged(inout WalkMerged walk, out uint light) {
  light = 0u;
  while (walk.bits == 0u) {
    if (!lookup_next_open_word(walk)) return false;
    walk.own_bits = lookup_word(walk.own, walk.at);
    walk.bits = subgroupOr(walk.own_bits);
  }
  const uint bit = LAMP_FIRST_BIT(walk.bits);
  walk.bits &= walk.bits - 1u;
  walk.mine = (walk.own_bits >> bit & 1u) != 0u;
  light = LOOKUP_LIGHT(walk.own, walk.at * 32u + bit);
  return true;
}

#define LOOKUP_EACH(light, pixel, z_view)                                        \
  for (WalkMerged lookup_walk = walk_begin_merged(walk_begin(pixel, z_view)); walk_next_merged(lookup_walk, light);) \
    if (lookup_walk.mine)
#ifdef LOOKUP_RANGED
#define LOOKUP_EACH_RANGED(id, pixel, z_view, first, end)                                \
  for (WalkMerged lookup_walk = walk_begin_merged(walk_begin_in(pixel, z_view, first, end)); \
       walk_next_merged(lookup_walk, id);)                                               \
    if (lookup_walk.mine)
#endif
