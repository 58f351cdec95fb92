// Look-up by position, of lights that stand still: the leaf of a tree that the host made ahead, and the bits of the
// position's cell in it. A pixel asks by its own position. Lights ascend.
// SPDX-License-Identifier: Apache-2.0
#include "common/language.glsl"
#include "lamplight/shared/world_tree.h"
#include "lookup/parts/resources.glsl"

LOOKUP_BUFFER(1, LookupTree, uint, lookup_tree);

#include "lookup/parts/pixel_position.glsl"
#define LOOKUP_CELL_WORD(word) lookup_tree[word]
#include "lookup/parts/cell_field.glsl"

void lookup_prepare() {}

struct Walk {
  uint kind;   // of the leaf
  uint place;  // of its words: the count, then the lights
  uint count;
  uint cell;
  uint block;  // of 32 lights: the first of them
  uint bits;   // lights of the block that come next
};

// A leaf, and the position's cell in it. Positions outside of the root, and what is no number, have a leaf of their own.
struct TreePlace {
  uint node;
  uint cell;
};

TreePlace lookup_leaf(vec3 position) {
  TreePlace place;
  place.node = lookup_tree[TREE_OUTSIDE];
  place.cell = 0u;
  vec3 low;
  low.x = LAMP_AS_FLOAT(lookup_tree[TREE_LOW_X]);
  low.y = LAMP_AS_FLOAT(lookup_tree[TREE_LOW_Y]);
  low.z = LAMP_AS_FLOAT(lookup_tree[TREE_LOW_Z]);
  const vec3 at = floor(position * LAMP_AS_FLOAT(lookup_tree[TREE_SCALE]) - low);
  uint shift = lookup_tree[TREE_LEVELS];
  const float size = float(4u << shift);
  // Each by itself: the maximum of what is no number and a number may be either.
  const bool lies = at.x >= 0.0 && at.y >= 0.0 && at.z >= 0.0 && at.x < size && at.y < size && at.z < size;
  if (!lies) return place;
  const uvec3 finest = uvec3(at);
  uint node = lookup_tree[TREE_ROOT];
  for (; node >> TREE_KIND_BIT == TREE_INNER; --shift) {
    const uint x = finest.x >> (shift + 1u) & 1u;
    const uint y = finest.y >> (shift + 1u) & 1u;
    const uint z = finest.z >> (shift + 1u) & 1u;
    node = lookup_tree[(node & TREE_PLACE) + x + 2u * y + 4u * z];
  }
  place.node = node;
  place.cell = (finest.x >> shift & 3u) + 4u * ((finest.y >> shift & 3u) + 4u * (finest.z >> shift & 3u));
  return place;
}

// Of the block that begins at walk.block.
uint lookup_block(Walk walk) {
  const uint width = min(walk.count - walk.block, 32u);
  if (walk.kind == TREE_CELLS)
    return lookup_field(walk.place + 1u + walk.count + 2u * walk.block, walk.cell, width);
  return 0xffffffffu >> (32u - width);
}

Walk world_walk_begin(uint view, vec3 position) {
  const TreePlace place = lookup_leaf(position);
  Walk walk;
  walk.kind = place.node >> TREE_KIND_BIT;
  walk.place = place.node & TREE_PLACE;
  walk.cell = place.cell;
  walk.block = 0u;
  walk.bits = 0u;
  walk.count = lookup_light_count();
  if (walk.kind != TREE_ALL) walk.count = lookup_tree[walk.place];
  if (walk.count != 0u) walk.bits = lookup_block(walk);
  return walk;
}
Walk world_walk_begin(vec3 position) { return world_walk_begin(LOOKUP_VIEW, position); }

bool world_walk_next(inout Walk walk, out uint light) {
  light = 0u;
  while (walk.bits == 0u) {
    walk.block += 32u;
    if (walk.block >= walk.count) return false;
    walk.bits = lookup_block(walk);
  }
  light = walk.block + LAMP_FIRST_BIT(walk.bits);
  walk.bits &= walk.bits - 1u;
  if (walk.kind != TREE_ALL) light = lookup_tree[walk.place + 1u + light];
  return true;
}

// Of a pixel: its leaf and cell, as one number.
uint lookup_cell(uint view, uvec2 pixel, float z_view) {
  const TreePlace place = lookup_leaf(lookup_position(view, pixel, z_view));
  return (place.node & TREE_PLACE) * 64u + place.cell;
}

Walk walk_begin(uint view, uvec2 pixel, float z_view) {
  return world_walk_begin(view, lookup_position(view, pixel, z_view));
}
bool walk_next(inout Walk walk, out uint light) { return world_walk_next(walk, light); }
#include "lookup/parts/of_view.glsl"
