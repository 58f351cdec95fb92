// Look-up: a row's lights as bits over the lights of each piece of its cell. A cell whose lights did not fit means every
// light.
// SPDX-License-Identifier: Apache-2.0
#include "lookup/parts/lamplight_cell.glsl"
#define LOOKUP_TOGETHER (LOOKUP_SLICES == 1u)

LOOKUP_BUFFER(2, LookupBits, uint, lookup_bits);
LOOKUP_BUFFER(3, LookupPieceLists, uint, lookup_piece_lists);
LOOKUP_VIEW_WORDS(2, LOOKUP_BITS_VIEW);
LOOKUP_VIEW_WORDS(3, LOOKUP_PIECE_LISTS_VIEW);

struct Walk {
  uint bits;   // of the word that was read last, those that are left
  uint base;   // of its entries in the lists of pieces, or of all lights
  uint word;   // the next of the row's words in all pieces
  uint words;  // end of them
  uint row;
  uint first;   // piece
  uint second;  // less one
  bool all;     // a word is 32 of all lights
  uint view;
};

Walk walk_begin(uint view, uvec2 pixel, float z_view) {
  const uint index = lookup_light_cell(view, pixel, z_view);
  const LightCell cell = lookup_cell_at(view, index);
  bool at_cell = LOOKUP_FIRST_AT_CELL != 0u;
  Walk walk;
  walk.view = view;
  walk.all = cell.pieces == ALL_LIGHTS;
  walk.bits = 0u;
  walk.base = 0u;
  walk.word = 0u;
  walk.words = ((walk.all ? lookup_light_count() : cell.entries) + 31u) / 32u;
  walk.row = lookup_row(view, pixel, z_view);
  walk.first = at_cell ? index : cell.first_piece;
  walk.second = at_cell ? cell.first_piece - 1u : cell.first_piece;
  return walk;
}
#include "lookup/parts/of_view.glsl"

// Of all lights, each word is full but the last.
void lookup_next_word(inout Walk walk) {
  const uint word = walk.word++;
  walk.base = 32u * word;
  if (walk.all) {
    const uint left = lookup_light_count() - walk.base;
    walk.bits = left < 32u ? (1u << left) - 1u : ~0u;
    return;
  }
  const uint piece = word / PIECE_WORDS;
  const uint place = piece == 0u ? walk.first : walk.second + piece;
  const uint row_word = (place * lookup_cell_rows(walk.view) + walk.row) * PIECE_WORDS + word % PIECE_WORDS;
  walk.bits = lookup_bits[walk.view * LOOKUP_BITS_VIEW + row_word];
  walk.base += (place - piece) * PIECE;
}

bool walk_word(inout Walk walk) {
  while (walk.bits == 0u) {
    if (walk.word >= walk.words) return false;
    lookup_next_word(walk);
  }
  return true;
}

uint lookup_light_of(Walk walk, uint bit) {
  if (walk.all) return walk.base + bit;
  return lookup_piece_lists[walk.view * LOOKUP_PIECE_LISTS_VIEW + walk.base + bit];
}

#include "lookup/parts/walk_words.glsl"
