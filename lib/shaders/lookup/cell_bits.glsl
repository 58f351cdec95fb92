// Look-up: a row's lights as bits over the lights of each piece of its cell. A cell whose lights did not fit means every
// light.
// SPDX-License-Identifier: Apache-2.0
#include "lookup/parts/lamplight_cell.glsl"
#define LOOKUP_TOGETHER (LOOKUP_SLICES == 1u)

layout(set = 0, binding = 18, scalar) readonly buffer LookupBits { uint lookup_bits[]; };
layout(set = 0, binding = 19, scalar) readonly buffer LookupPieceLists { uint lookup_piece_lists[]; };

struct Walk {
  uint bits;       // of the word that was read last, those that are left
  uint base;       // of its entries in the lists of pieces, or of all lights
  uint word;       // the next of the row's words in all pieces
  uint words;      // end of them
  uint first_bit;  // where the row's words of the first piece are
  bool all;        // a word is 32 of all lights
};

Walk walk_begin(uvec2 pixel, float z_view) {
  const LightCell cell = lookup_light_cell(pixel, z_view);
  if (cell.pieces == ALL_LIGHTS) return Walk(0u, 0u - 32u, 0u, (lookup_frame.light_count + 31u) / 32u, 0u, true);
  const uint first = (cell.first_piece * LOOKUP_CELL_ROWS + lookup_row(pixel, z_view)) * PIECE_WORDS;
  return Walk(0u, cell.first_piece * PIECE - 32u, 0u, (cell.entries + 31u) / 32u, first, false);
}

// Of all lights, each word is full but the last.
uint lookup_next_word(Walk walk) {
  if (walk.all) {
    const uint left = lookup_frame.light_count - 32u * walk.word;
    return left < 32u ? (1u << left) - 1u : ~0u;
  }
  const uint piece = walk.word / PIECE_WORDS;
  return lookup_bits[walk.first_bit + piece * (LOOKUP_CELL_ROWS - 1u) * PIECE_WORDS + walk.word];
}

bool walk_word(inout Walk walk) {
  while (walk.bits == 0u) {
    if (walk.word >= walk.words) return false;
    walk.bits = lookup_next_word(walk);
    walk.base += 32u;
    ++walk.word;
  }
  return true;
}

uint lookup_light_of(Walk walk, uint bit) {
  if (walk.all) return walk.base + bit;
  return lookup_piece_lists[walk.base + bit];
}

#include "lookup/parts/walk_words.glsl"
