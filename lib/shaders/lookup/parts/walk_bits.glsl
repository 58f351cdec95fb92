// Walks a flat bit array, lowest bit first, between two bits: bit N is LOOKUP_LIGHT(walk, N).
// Based on: Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017), "Data Container: Flat".
// Needs: `lookup_bits`, the macro LOOKUP_LIGHT(walk, bit).
// SPDX-License-Identifier: Apache-2.0
struct Walk {
  uint base;   // of the cell's words
  uint begin;  // bits begin .. end - 1 count
  uint end;
  uint word;  // the next word to read
  uint bits;  // of word - 1, not yet walked
};

Walk walk_bits(uint base, uint begin, uint end) {
  Walk walk;
  walk.base = base;
  walk.begin = begin;
  walk.end = end;
  walk.word = begin / 32u;
  walk.bits = 0u;
  return walk;
}

// A word of the cell without the bits outside begin .. end - 1; any word may be asked for.
uint lookup_word(Walk walk, uint word) {
  const uint first = word * 32u;
  if (first >= walk.end || first + 32u <= walk.begin) return 0u;
  uint bits = lookup_bits[walk.base + word];
  if (first < walk.begin) bits &= ~0u << (walk.begin - first);
  if (first + 32u > walk.end) bits &= (1u << (walk.end - first)) - 1u;
  return bits;
}

bool walk_word(inout Walk walk) {
  while (walk.bits == 0u) {
    if (walk.word * 32u >= walk.end) return false;
    walk.bits = lookup_word(walk, walk.word);
    ++walk.word;
  }
  return true;
}

uint lookup_light_of(Walk walk, uint bit) { return LOOKUP_LIGHT(walk, (walk.word - 1u) * 32u + bit); }

#include "lookup/parts/walk_words.glsl"
