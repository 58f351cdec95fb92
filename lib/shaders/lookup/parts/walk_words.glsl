// Walks the set bits of words, lowest first: one by one, or many at once.
// Needs: Walk with `bits`, of the word that was read last, those that are left; walk_word(walk), which reads on until
// there are some, or gives false; lookup_light_of(walk, bit).
// SPDX-License-Identifier: Apache-2.0
#include "lookup/parts/nth_bit.glsl"

// Of the word, which has some.
uint lookup_lowest(inout Walk walk) {
  const uint light = lookup_light_of(walk, LAMP_FIRST_BIT(walk.bits));
  walk.bits &= walk.bits - 1u;
  return light;
}

bool walk_next(inout Walk walk, out uint light) {
  light = 0u;
  if (!walk_word(walk)) return false;
  light = lookup_lowest(walk);
  return true;
}

uint walk_take(inout Walk walk, uint most, uint rank, out uint light) {
  uint taken = 0u;
  light = 0u;
  while (walk_word(walk)) {
    const uint count = LAMP_BIT_COUNT(walk.bits);
    if (taken + count > most) break;
    if (rank - taken < count) light = lookup_light_of(walk, lookup_nth_bit(walk.bits, rank - taken));
    taken += count;
    walk.bits = 0u;
  }
  return taken;
}
