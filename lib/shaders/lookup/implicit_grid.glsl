// Look-up by position: lights whose bit is set in the slice of each axis. Blocks of 1024 lights are looked at through a
// word that says which words of bits have any. A pixel asks by its own position. Lights come in the order that they were
// sorted in.
// Based on: Ikkala et al., Hierarchical Bitmask Implicit Grids, GRAPP (2024).
// SPDX-License-Identifier: Apache-2.0
#include "common/implicit_grid.glsl"
#include "lookup/parts/resources.glsl"

LOOKUP_CONSTANT(0, uint, LOOKUP_SLICES, 8);
LOOKUP_CONSTANT(1, uint, LOOKUP_BLOCKS, 1);  // of the capacity
LOOKUP_CONSTANT(2, uint, LOOKUP_SORTED, 1);  // 0: lights have the places of their own indices
LOOKUP_BUFFER(1, LookupGrids, ImplicitGrid, lookup_grids);
LOOKUP_BUFFER(2, LookupBlockWords, uint, lookup_block_words);
LOOKUP_BUFFER(3, LookupBits, uint, lookup_bits);
LOOKUP_BUFFER(4, LookupOrder, uint, lookup_order);
LOOKUP_VIEW_WORDS(1, LOOKUP_GRIDS_VIEW);
LOOKUP_VIEW_WORDS(2, LOOKUP_BLOCK_WORDS_VIEW);
LOOKUP_VIEW_WORDS(3, LOOKUP_BITS_VIEW);
LOOKUP_VIEW_WORDS(4, LOOKUP_ORDER_VIEW);

#include "lookup/parts/pixel_position.glsl"

void lookup_prepare() {}

struct Walk {
  uvec3 rows;    // of each axis' slice: its first block
  uint next;     // block
  uint blocks;   // of the frame's lights
  uint words;    // of the block before `next`, that are left
  uint word;     // whose bits are walked, counted through all lights
  uint bits;     // of them, that are left
  uint view;
};

uvec3 lookup_slices(uint view, vec3 position) {
  return grid_slices(lookup_grids[view * (LOOKUP_GRIDS_VIEW / 8u)], position, LOOKUP_SLICES);
}

Walk world_walk_begin(uint view, vec3 position) {
  const uvec3 slices = lookup_slices(view, position);
  Walk walk;
  walk.rows.x = slices.x * LOOKUP_BLOCKS;
  walk.rows.y = (slices.y + (LOOKUP_SLICES + 1u)) * LOOKUP_BLOCKS;
  walk.rows.z = (slices.z + 2u * (LOOKUP_SLICES + 1u)) * LOOKUP_BLOCKS;
  walk.next = 0u;
  walk.blocks = (lookup_light_count() + GRID_BLOCK - 1u) / GRID_BLOCK;
  walk.words = 0u;
  walk.word = 0u;
  walk.bits = 0u;
  walk.view = view;
  return walk;
}
Walk world_walk_begin(vec3 position) { return world_walk_begin(LOOKUP_VIEW, position); }

// Words of a block that have bits along all axes.
uint lookup_words(Walk walk, uint block) {
  const uint base = walk.view * LOOKUP_BLOCK_WORDS_VIEW + block;
  return lookup_block_words[base + walk.rows.x] & lookup_block_words[base + walk.rows.y] &
         lookup_block_words[base + walk.rows.z];
}

// Bits of a word that all axes have.
uint lookup_word(Walk walk, uint word) {
  const uint base = walk.view * LOOKUP_BITS_VIEW + word;
  return lookup_bits[base + walk.rows.x * GRID_BLOCK_WORDS] & lookup_bits[base + walk.rows.y * GRID_BLOCK_WORDS] &
         lookup_bits[base + walk.rows.z * GRID_BLOCK_WORDS];
}

bool world_walk_next(inout Walk walk, out uint light) {
  light = 0u;
  while (walk.bits == 0u) {
    while (walk.words == 0u) {
      if (walk.next >= walk.blocks) return false;
      walk.words = lookup_words(walk, walk.next);
      ++walk.next;
    }
    walk.word = (walk.next - 1u) * GRID_BLOCK_WORDS + LAMP_FIRST_BIT(walk.words);
    walk.words &= walk.words - 1u;
    walk.bits = lookup_word(walk, walk.word);
  }
  light = walk.word * 32u + LAMP_FIRST_BIT(walk.bits);
  walk.bits &= walk.bits - 1u;
  if (LOOKUP_SORTED != 0u) light = lookup_order[walk.view * LOOKUP_ORDER_VIEW + light];
  return true;
}

// Of a pixel: its slices, as one number.
uint lookup_cell(uint view, uvec2 pixel, float z_view) {
  const uvec3 slices = lookup_slices(view, lookup_position(view, pixel, z_view));
  return slices.x + (LOOKUP_SLICES + 1u) * (slices.y + (LOOKUP_SLICES + 1u) * slices.z);
}

Walk walk_begin(uint view, uvec2 pixel, float z_view) {
  return world_walk_begin(view, lookup_position(view, pixel, z_view));
}
bool walk_next(inout Walk walk, out uint light) { return world_walk_next(walk, light); }
#include "lookup/parts/of_view.glsl"
