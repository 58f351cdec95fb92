// One list a tile and depth range, a count and its lights; a count beyond the capacity means every light.
// SPDX-License-Identifier: Apache-2.0
#include "lookup/parts/resources.glsl"

LOOKUP_CONSTANT(0, uint, LOOKUP_TILE_PX, 16);
LOOKUP_CONSTANT(1, uint, LOOKUP_CAPACITY, 512);
LOOKUP_CONSTANT(2, uint, LOOKUP_RANGES, 1);
LOOKUP_CONSTANT(3, bool, LOOKUP_ASCENDS, false);  // a list that ascends can be cut to a range of ids
LOOKUP_BUFFER(1, LookupLists, uint, lookup_lists);
LOOKUP_BUFFER(2, LookupSplits, float, lookup_splits);
LOOKUP_VIEW_WORDS(1, LOOKUP_LISTS_VIEW);
LOOKUP_VIEW_WORDS(2, LOOKUP_SPLITS_VIEW);

#include "lookup/parts/list_walk.glsl"
#include "lookup/parts/tile_cell.glsl"

void lookup_prepare() {}

Walk walk_nothing() { return walk_from(0u, 0u, false); }

Walk walk_of_cell(uint view, uint cell) {
  const uint base = view * LOOKUP_LISTS_VIEW + cell * (1u + LOOKUP_CAPACITY);
  const uint count = lookup_lists[base];
  if (count > LOOKUP_CAPACITY) return walk_from(0u, lookup_light_count(), true);
  return walk_from(base + 1u, base + 1u + count, false);
}

#include "lookup/parts/lower_bound.glsl"

Walk walk_of_cell_in(uint view, uint cell, uint first, uint end) {
  Walk walk = walk_of_cell(view, cell);
  if (walk.overflowed) return walk_from(first, min(end, walk.end), true);
  if (!LOOKUP_ASCENDS) return walk;
  walk.at = lookup_lower_bound(walk.at, walk.end, first);
  walk.end = lookup_lower_bound(walk.at, walk.end, end);
  return walk;
}

#include "lookup/parts/walk_cell.glsl"

uint lookup_light_at(Walk walk, uint place) {
  if (walk.overflowed) return place;
  return lookup_lists[place];
}

#include "lookup/parts/walk_places.glsl"
