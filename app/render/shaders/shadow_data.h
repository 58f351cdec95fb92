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
};

// VkDrawIndexedIndirectCommand
struct ShadowDraw {
  uint indices;
  uint instances;  // views that show the caster
  uint first_index;
  uint vertex_offset;
  uint first_instance;  // where the caster's views begin among the pairs
};

// Push constants.
struct ShadowBatch {
  uint first_view;
  uint views;
  uint casters;
};

#ifdef __cplusplus
static_assert(sizeof(ShadowCaster) == 20 && sizeof(ShadowDraw) == 20 && sizeof(ShadowBatch) == 12);
}  // namespace lamp::app::gpu
#endif

#endif
