// Walks flat bit arrays with one light at a time for the whole subgroup: the words of its threads are merged, and a thread
// takes part in the lights that are its own. What is loaded for a light is then the same for all threads.
// Based on: Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017), "Scalarization".
// Promise: each thread meets exactly the lights of walk_next, in the same order, whichever threads are active with it.
// Needs: walk_bits.glsl.
// SPDX-License-Identifier: Apache-2.0
#extension GL_KHR_shader_subgroup_arithmetic : require

struct WalkMerged {
  Walk own;
  uint word;      // the next word to read
  uint end;       // of the words that some thread has
  uint own_bits;  // of word - 1
  uint bits;      // of word - 1 and all threads, not yet walked
  bool mine;      // the light is among the thread's own
};

WalkMerged walk_begin_merged(Walk own) {
  const bool any_bit = own.begin < own.end;
  const uint word = subgroupMin(any_bit ? own.begin / 32u : ~0u);
  const uint end = subgroupMax(any_bit ? (own.end + 31u) / 32u : 0u);
  return WalkMerged(own, word, end, 0u, 0u, false);
}

// A thread's own bits are always among the merged ones, so threads that have parted company lose nothing.
bool walk_next_merged(inout WalkMerged walk, out uint light) {
  while (walk.bits == 0u) {
    if (walk.word >= walk.end) return false;
    walk.own_bits = lookup_word(walk.own, walk.word);
    walk.bits = subgroupOr(walk.own_bits);
    ++walk.word;
  }
  const uint bit = uint(findLSB(walk.bits));
  walk.bits &= walk.bits - 1u;
  walk.mine = (walk.own_bits >> bit & 1u) != 0u;
  light = LOOKUP_LIGHT((walk.word - 1u) * 32u + bit);
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
