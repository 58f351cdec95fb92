// How lights that stand still are looked up.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_STILL_DATA_H
#define LAMP_STILL_DATA_H

#include "lamplight/shared/glsl.h"

#ifdef __cplusplus
namespace lamp::app::gpu {
using namespace lamp::shared;
#endif

LAMP_CONST STILL_OFF = 0u;        // all lights are the picture's
LAMP_CONST STILL_TRIANGLES = 1u;  // by a pixel's triangle and its position (triangle_lists.h)
LAMP_CONST STILL_TREE = 2u;       // by its position (world_tree.h)

// A position that is asked, and what a walk met there.
struct StillPoint {
  vec3 position;
  uint triangle;
};
struct StillWalk {
  uint lights;
  uint hash;  // Fowler, Noll, Vo, FNV-1a, of whole numbers
};
LAMP_CONST STILL_HASH_FIRST = 2166136261u;
LAMP_CONST STILL_HASH_TIMES = 16777619u;

#ifdef __cplusplus
}  // namespace lamp::app::gpu
#endif

#endif
