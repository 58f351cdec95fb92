// Look-up by position, of lights that stand still: the leaf of a tree that the host made ahead, and the bits of the
// position's cell in it. A pixel asks by its own position. Lights ascend.
// SPDX-License-Identifier: Apache-2.0
#include "common/language.glsl"
#include "lookup/parts/resources.glsl"

LOOKUP_BUFFER(1, LookupTree, uint, lookup_tree);

#include "lookup/parts/pixel_position.glsl"
#define TREE_WORD(word) lookup_tree[word]
#define TREE_EVERY_LIGHT lookup_light_count()
#define TREE_BEGIN lookup_begin
#define TREE_NEXT lookup_next
#define TREE_LEAF lookup_leaf
#define TREE_BLOCK lookup_block
#define TREE_FIELD lookup_field
#include "world/parts/tree_walk.glsl"

void lookup_prepare() {}

struct Walk {
  TreeWalk tree;
};

Walk world_walk_begin(uint view, vec3 position) {
  Walk walk;
  walk.tree = lookup_begin(position);
  return walk;
}
Walk world_walk_begin(vec3 position) { return world_walk_begin(LOOKUP_VIEW, position); }

bool world_walk_next(inout Walk walk, out uint light) { return lookup_next(walk.tree, light); }

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
