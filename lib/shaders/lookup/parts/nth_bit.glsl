// The place of a set bit by its rank: halves of the word that hold too few are passed over.
// SPDX-License-Identifier: Apache-2.0
#ifndef LOOKUP_NTH_BIT
#define LOOKUP_NTH_BIT

// `rank` is less than how many bits are set.
uint lookup_nth_bit(uint bits, uint rank) {
  uint place = 0u;
  for (uint width = 16u; width > 0u; width /= 2u) {
    const uint below = LAMP_BIT_COUNT(LAMP_BITS(bits, place, width));
    if (rank < below) continue;
    rank -= below;
    place += width;
  }
  return place;
}

#endif
