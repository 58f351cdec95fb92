// What drawing shadow maps reads: pieces of meshes that cast shadows, and the numbers of a batch of views.
// Promise: scalar layout, the same bytes in C++ and in GLSL.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_SHADOW_DATA_H
#define LAMP_SHADOW_DATA_H

#include "lamplight/shared/shadow.h"

#ifdef __cplusplus
namespace lamp::app::gpu {
using namespace lamp::shared;
#endif

// A cluster of an instance's triangles.
struct ShadowCaster {
  vec3 center;  // of a sphere around it, in the object's space
  float radius;
  uint instance;
  uint group;  // of casters of one material
};

// Views that are drawn together, each with a scissor of its own: as many viewports as every device has that has
// several.
LAMP_CONST VIEWS_A_DRAW = 16u;

// VkDrawIndexedIndirectCommand
struct ShadowDraw {
  uint indices;
  uint instances;  // views that show the caster
  uint first_index;
  uint vertex_offset;
  uint first_instance;  // where these begin among the pairs
};

// Push constants of finding pairs.
struct ShadowBatch {
  uint first_view;
  uint views;
  uint casters;
};

// Rasterization in compute.

// Casters of one material, and how much of them there is to draw.
struct ShadowGroup {
  uint first_caster;
  uint pairs;  // of caster and view, from first_caster times the views of a batch on
  uint items;  // blocks of large triangles; more than there is room for count too
};

// A square to clear.
struct ShadowSquare {
  uvec2 corner;  // texel
  uint side;
};

// Push constants of drawing them.
struct ShadowRasterBatch {
  uint first_view;
  uint group;
  uint most_items;
};

// An item: the pair; the triangle in its caster, and from these bits on the block in the square.
LAMP_CONST SHADOW_BLOCK_X_BIT = 16u;
LAMP_CONST SHADOW_BLOCK_Y_BIT = 24u;

#ifdef __cplusplus
static_assert(sizeof(ShadowCaster) == 24 && sizeof(ShadowDraw) == 20 && sizeof(ShadowGroup) == 12);
}  // namespace lamp::app::gpu
#endif

#endif
