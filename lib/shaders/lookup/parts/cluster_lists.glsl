// Clusters, each a range of one shared list. NO_RANGE means what the tile's bits say, and every light where there are no
// bits.
// SPDX-License-Identifier: Apache-2.0
#include "lookup/parts/cluster_cell.glsl"

LOOKUP_CONSTANT(5, uint, LOOKUP_WORDS, 0);  // of a tile's bits
LOOKUP_BUFFER(1, LookupRanges, uvec2, lookup_ranges);
LOOKUP_BUFFER(2, LookupLists, uint, lookup_lists);
LOOKUP_BUFFER(3, LookupBits, uint, lookup_bits);
LOOKUP_VIEW_WORDS(1, LOOKUP_RANGES_VIEW);
LOOKUP_VIEW_WORDS(2, LOOKUP_LISTS_VIEW);
LOOKUP_VIEW_WORDS(3, LOOKUP_BITS_VIEW);

struct Walk {
  uint at;
  uint end;
  uint first_word;  // of the tile's bits; LOOKUP_NO_WORD: `at` is an entry of the list
};
LAMP_CONST LOOKUP_NO_WORD = ~0u;

Walk walk_from(uint first, uint end, uint first_word) {
  Walk walk;
  walk.at = first;
  walk.end = end;
  walk.first_word = first_word;
  return walk;
}

Walk walk_nothing() { return walk_from(0u, 0u, LOOKUP_NO_WORD); }

Walk walk_of_cell(uint view, uint cell) {
  const uvec2 range = lookup_ranges[view * (LOOKUP_RANGES_VIEW / 2u) + cell];
  const uint first = view * LOOKUP_LISTS_VIEW + range.x;
  if (range.y != NO_RANGE) return walk_from(first, first + range.y, LOOKUP_NO_WORD);
  const uint tile = cell % square_count(lookup_frames[view], LOOKUP_TILE_PX);
  const uint first_word = view * LOOKUP_BITS_VIEW + tile * LOOKUP_WORDS;
  return walk_from(0u, lookup_light_count(), first_word);
}

#include "lookup/parts/lower_bound.glsl"

Walk walk_of_cell_in(uint view, uint cell, uint first, uint end) {
  Walk walk = walk_of_cell(view, cell);
  if (walk.first_word != LOOKUP_NO_WORD) return walk_from(first, min(end, walk.end), walk.first_word);
  walk.at = lookup_lower_bound(walk.at, walk.end, first);
  walk.end = lookup_lower_bound(walk.at, walk.end, end);
  return walk;
}

#include "lookup/parts/walk_cell.glsl"

// The first light from `from` on that the tile's bits name, or one past the last.
uint lookup_next_bit(uint first_word, uint from, uint end) {
  while (from < end) {
    const uint bits = lookup_bits[first_word + from / 32u] >> (from % 32u);
    if (bits != 0u) return from + LAMP_FIRST_BIT(bits);
    from = (from / 32u + 1u) * 32u;
  }
  return end;
}

bool walk_next(inout Walk walk, out uint light) {
  light = 0u;
  if (walk.first_word != LOOKUP_NO_WORD && LOOKUP_WORDS != 0u)
    walk.at = lookup_next_bit(walk.first_word, walk.at, walk.end);
  if (walk.at >= walk.end) return false;
  light = walk.at;
  if (walk.first_word == LOOKUP_NO_WORD) light = lookup_lists[walk.at];
  ++walk.at;
  return true;
}
