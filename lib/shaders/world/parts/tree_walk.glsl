// The walk of a tree that the host made of lights that stand still: the leaf of a position, and the bits of its cell in it.
// Needs: TREE_WORD(word), which reads one; TREE_EVERY_LIGHT, how many lights there are where the tree has no list; names
// of functions: TREE_BEGIN, TREE_NEXT, TREE_LEAF, TREE_BLOCK, TREE_FIELD. All are forgotten then: a shader may include
// this for several trees.
// SPDX-License-Identifier: Apache-2.0
#include "common/language.glsl"
#include "lamplight/shared/world_tree.h"
#define CELL_FIELD TREE_FIELD
#define CELL_FIELD_WORD(word) TREE_WORD(word)
#include "lookup/parts/cell_field.glsl"

#ifndef LAMP_TREE_WALK
#define LAMP_TREE_WALK
struct TreeWalk {
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
#endif

TreePlace TREE_LEAF(vec3 position) {
  TreePlace place;
  place.node = TREE_WORD(TREE_OUTSIDE);
  place.cell = 0u;
  vec3 low;
  low.x = LAMP_AS_FLOAT(TREE_WORD(TREE_LOW_X));
  low.y = LAMP_AS_FLOAT(TREE_WORD(TREE_LOW_Y));
  low.z = LAMP_AS_FLOAT(TREE_WORD(TREE_LOW_Z));
  const vec3 at = floor(position * LAMP_AS_FLOAT(TREE_WORD(TREE_SCALE)) - low);
  uint shift = TREE_WORD(TREE_LEVELS);
  const float size = float(4u << shift);
  // Each by itself: the maximum of what is no number and a number may be either.
  const bool lies = at.x >= 0.0 && at.y >= 0.0 && at.z >= 0.0 && at.x < size && at.y < size && at.z < size;
  if (!lies) return place;
  const uvec3 finest = uvec3(at);
  uint node = TREE_WORD(TREE_ROOT);
  // Bounded: a pixel's helper that reads nothing but zeros would go down for ever.
  for (uint level = 0u; level < TREE_MOST_LEVELS && node >> TREE_KIND_BIT == TREE_INNER; ++level, --shift) {
    const uint x = finest.x >> (shift + 1u) & 1u;
    const uint y = finest.y >> (shift + 1u) & 1u;
    const uint z = finest.z >> (shift + 1u) & 1u;
    node = TREE_WORD((node & TREE_PLACE) + x + 2u * y + 4u * z);
  }
  place.node = node;
  place.cell = (finest.x >> shift & 3u) + 4u * ((finest.y >> shift & 3u) + 4u * (finest.z >> shift & 3u));
  return place;
}

// Of the block that begins at walk.block.
uint TREE_BLOCK(TreeWalk walk) {
  const uint width = min(walk.count - walk.block, 32u);
  if (walk.kind == TREE_CELLS)
    return TREE_FIELD(walk.place + 1u + walk.count + 2u * walk.block, walk.cell * width, width);
  return 0xffffffffu >> (32u - width);
}

TreeWalk TREE_BEGIN(vec3 position) {
  const TreePlace place = TREE_LEAF(position);
  TreeWalk walk;
  walk.kind = place.node >> TREE_KIND_BIT;
  walk.place = place.node & TREE_PLACE;
  walk.cell = place.cell;
  walk.block = 0u;
  walk.bits = 0u;
  walk.count = TREE_EVERY_LIGHT;
  if (walk.kind != TREE_ALL) walk.count = TREE_WORD(walk.place);
  if (walk.count != 0u) walk.bits = TREE_BLOCK(walk);
  return walk;
}
bool TREE_NEXT(inout TreeWalk walk, out uint light) {
  light = 0u;
  while (walk.bits == 0u) {
    walk.block += 32u;
    if (walk.block >= walk.count) return false;
    walk.bits = TREE_BLOCK(walk);
  }
  light = walk.block + LAMP_FIRST_BIT(walk.bits);
  walk.bits &= walk.bits - 1u;
  if (walk.kind != TREE_ALL) light = TREE_WORD(walk.place + 1u + light);
  return true;
}

#undef TREE_WORD
#undef TREE_EVERY_LIGHT
#undef TREE_BEGIN
#undef TREE_NEXT
#undef TREE_LEAF
#undef TREE_BLOCK
#undef TREE_FIELD
