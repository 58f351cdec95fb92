// What `world-tree` keeps in one buffer of 32-bit words, made ahead on the host: a header, an octree, lists with bits.
// Promise: the same words in C++, in GLSL and in HLSL.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMPLIGHT_SHARED_WORLD_TREE_H
#define LAMPLIGHT_SHARED_WORLD_TREE_H

#include "glsl.h"

#ifdef __cplusplus
namespace lamp::shared {
#endif

// The header's words. Cells are the finest there can be; the root is a cube of 4 * 2^levels of them.
LAMP_CONST TREE_LOW_X = 0u;  // float, cells: the root's low corner
LAMP_CONST TREE_LOW_Y = 1u;
LAMP_CONST TREE_LOW_Z = 2u;
LAMP_CONST TREE_SCALE = 3u;    // float, cells a metre: a power of two
LAMP_CONST TREE_LEVELS = 4u;   // halvings of the root, at most
LAMP_CONST TREE_ROOT = 5u;     // node
LAMP_CONST TREE_OUTSIDE = 6u;  // node, a plain leaf: of points outside of the root
LAMP_CONST TREE_LIGHTS = 7u;   // how many there are
LAMP_CONST TREE_HEADER = 8u;   // words

LAMP_CONST TREE_MOST_LEVELS = 18u;

// A node is a word: a kind, and the place of words. An inner node's words are its 8 children, child x + 2 y + 4 z. A
// leaf's are a count and as many lights, ascending; a leaf has 4 x 4 x 4 cells. A plain one's lights are those of all
// cells. In another the cells' bits follow, in blocks of 32 lights: in a block of n each cell has n bits, one cell
// behind the other, cell x + 4 y + 16 z.
LAMP_CONST TREE_KIND_BIT = 30u;
LAMP_CONST TREE_INNER = 0u;
LAMP_CONST TREE_PLAIN = 1u;
LAMP_CONST TREE_CELLS = 2u;
LAMP_CONST TREE_ALL = 3u;  // no words: every light of the frame
LAMP_CONST TREE_PLACE = 0x3fffffffu;

#ifdef __cplusplus
}  // namespace lamp::shared
#endif

#endif
