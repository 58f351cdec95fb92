// Look-up: a row's lights as bits over the lights of each piece of its cell. A cell whose lights did not fit means every
// light.
// SPDX-License-Identifier: Apache-2.0
#include "lookup/parts/lamplight_cell.glsl"
#include "lookup/parts/nth_bit.glsl"
#define LOOKUP_TOGETHER (LOOKUP_SLICES == 1u)

layout(set = 0, binding = 18, scalar) readonly buffer LookupBits { uint lookup_bits[]; };
layout(set = 0, binding = 19, scalar) readonly buffer LookupPieceLists { uint lookup_piece_lists[]; };

struct Walk {
  uint bits;       // of the word that was read last, those that are left
  uint base;       // of its entries in the lists of pieces
  uint word;       // the next of the row's words in all pieces
  uint words;      // end of them
  uint first_bit;  // where the row's words of the first piece are
  bool all;        // `word` is a light
};

Walk walk_begin(uvec2 pixel, float z_view) {
  const LightCell cell = lookup_light_cell(pixel, z_view);
  if (cell.pieces == ALL_LIGHTS) return Walk(0u, 0u, 0u, lookup_frame.light_count, 0u, true);
  const uint first = (cell.first_piece * LOOKUP_CELL_ROWS + lookup_row(pixel, z_view)) * PIECE_WORDS;
  return Walk(0u, cell.first_piece * PIECE - 32u, 0u, (cell.entries + 31u) / 32u, first, false);
}

// The next word with lights left; false if there is none. Not for all lights.
bool walk_word(inout Walk walk) {
  while (walk.bits == 0u) {
    if (walk.word >= walk.words) return false;
    const uint piece = walk.word / PIECE_WORDS;
    walk.bits = lookup_bits[walk.first_bit + piece * (LOOKUP_CELL_ROWS - 1u) * PIECE_WORDS + walk.word];
    walk.base += 32u;
    ++walk.word;
  }
  return true;
}

bool walk_next(inout Walk walk, out uint light) {
  if (walk.all) {
    light = walk.word++;
    return light < walk.words;
  }
  if (!walk_word(walk)) return false;
  light = lookup_piece_lists[walk.base + uint(findLSB(walk.bits))];
  walk.bits &= walk.bits - 1u;
  return true;
}

uint walk_take(inout Walk walk, uint most, uint rank, out uint light) {
  uint taken = 0u;
  light = walk.word + rank;
  if (walk.all) {
    taken = min(walk.words - walk.word, most);
    walk.word += taken;
    return taken;
  }
  while (walk_word(walk)) {
    const uint count = uint(bitCount(walk.bits));
    if (taken + count > most) break;
    if (rank - taken < count) light = lookup_piece_lists[walk.base + nth_bit(walk.bits, rank - taken)];
    taken += count;
    walk.bits = 0u;
  }
  return taken;
}
