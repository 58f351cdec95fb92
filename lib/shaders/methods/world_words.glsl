// Where the bits of entries lie, of which an entry has four halves of a word, or three.
// Needs: HALVES, CELL_HALVES or SLICE_HALVES.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/shared/world.h"

// A list begins with a word: where an entry has three halves, with an even entry.
uint first_word(uint entry) { return HALVES * entry / 2u; }
uint words_of(uint entries) { return (HALVES * entries + 1u) / 2u; }  // of a list
uint room_of(uint entries) { return entries + HALVES % 2u * (entries % 2u); }
