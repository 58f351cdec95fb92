// A corner of a triangle of a light's mesh.
// SPDX-License-Identifier: Apache-2.0
#ifndef MESH_CORNER_H
#define MESH_CORNER_H

#include "lamplight/shared/glsl.h"

#ifdef __cplusplus
namespace lamp::shared {
#endif

struct MeshCorner {
  vec3 position;  // m, from the light
  uint point;     // its number + 1; 0: there is none
  vec3 way;       // unit
  float flatness;
};

#ifdef __cplusplus
}  // namespace lamp::shared
#endif

#endif
