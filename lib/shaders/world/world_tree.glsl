// Look-up by position in a tree of still lights, ascending, for shaders that have another look-up besides: lists of a
// picture for the lights that move. Lights count from the tree's first.
//   for (TreeWalk walk = tree_walk_begin(position); tree_walk_next(walk, light);) shade(light);
// A shader may say WORLD_TREE_SET and WORLD_TREE_BINDING before it includes this, or, of a buffer that it has already,
// WORLD_TREE_WORD(word).
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_WORLD_TREE
#define LAMP_WORLD_TREE
#include "common/language.glsl"

#ifndef WORLD_TREE_WORD
#ifndef WORLD_TREE_SET
#define WORLD_TREE_SET 0
#endif
#ifndef WORLD_TREE_BINDING
#define WORLD_TREE_BINDING 15
#endif
#ifdef LAMP_HLSL
[[vk::binding(WORLD_TREE_BINDING, WORLD_TREE_SET)]] StructuredBuffer<uint> world_tree_words;
#else
layout(set = WORLD_TREE_SET, binding = WORLD_TREE_BINDING, scalar) readonly buffer WorldTreeWords {
  uint world_tree_words[];
};
#endif
#define WORLD_TREE_WORD(word) world_tree_words[word]
#endif

#define TREE_WORD(word) WORLD_TREE_WORD(word)
#define TREE_EVERY_LIGHT WORLD_TREE_WORD(TREE_LIGHTS)
#define TREE_BEGIN tree_walk_begin
#define TREE_NEXT tree_walk_next
#define TREE_LEAF tree_leaf
#define TREE_BLOCK tree_block
#define TREE_FIELD tree_field
#include "world/parts/tree_walk.glsl"

#endif
