// A bounding volume hierarchy on two levels, for rays in compute shaders: one over the triangles of each mesh, one over
// instances. A node has the boxes of its two children; what a child is, is a code: eight times a number, and a count of
// triangles or instances (0: another node).
// Promise: scalar layout, the same bytes in C++ and in GLSL; 16-byte words.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_BVH_DATA_H
#define LAMP_BVH_DATA_H

#include "lamplight/shared/glsl.h"

#ifdef __cplusplus
namespace lamp::app::gpu {
using namespace lamp::shared;
#endif

LAMP_CONST BVH_NOTHING = 0xffffffffu;  // in place of a code: there is nothing to meet
LAMP_CONST BVH_COUNTS = 8u;            // a code is a number times this, and a count below it

struct BvhNode {
  vec3 min_first;  // of the first child's box; m, in the space of the mesh or of the world
  uint first;      // its code
  vec3 max_first;
  uint second;
  vec3 min_second;
  uint unused_a;
  vec3 max_second;
  uint unused_b;
};

struct BvhTriangle {
  vec3 a;            // corners in the space of the mesh
  uint first_index;  // where the indices of its corners are
  vec3 b;
  uint unused_a;
  vec3 c;
  uint unused_b;
};

LAMP_CONST BVH_MASKED = 1u;        // its material cuts holes
LAMP_CONST BVH_DOUBLE_SIDED = 2u;  // back faces are met
LAMP_CONST BVH_FLIPPED = 4u;       // its matrix mirrors: front faces are clockwise
LAMP_CONST BVH_FLATTENED = 8u;     // its matrix has no inverse: its triangles are its own, in the world's space

struct BvhInstance {
  vec3 row_x;  // of the matrix from the world's directions to the mesh's
  uint root;   // code
  vec3 row_y;
  uint kind;  // of the bits above
  vec3 row_z;
  uint vertex_offset;
  vec3 origin;  // of the mesh's space in the world, m
  uint material;
  vec3 column_x;  // from the mesh's space to the world's
  uint scene_instance;
  vec3 column_y;
  uint unused_a;
  vec3 column_z;
  uint unused_b;
};

#ifdef __cplusplus
static_assert(sizeof(BvhNode) == 64 && sizeof(BvhTriangle) == 48 && sizeof(BvhInstance) == 112);
}  // namespace lamp::app::gpu
#endif

#endif
