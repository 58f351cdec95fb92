// An oriented box: what a decal or a reflection probe covers, for cells that hold more than lights.
// Based on: Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017): structures of
// entities. Promise: 60 bytes in C++ and in GLSL. SPDX-License-Identifier: Apache-2.0
#ifndef LAMPLIGHT_SHARED_ENTITY_H
#define LAMPLIGHT_SHARED_ENTITY_H

#include "glsl.h"

#ifdef __cplusplus
namespace lamp::shared {
#endif

// World space. The axes are unit, at right angles; a decal is projected against axis_z. The half extents may also be
// the half axes of an ellipsoid (lamp::EntityShape).
struct OrientedBox {
  vec3 center;  // m
  vec3 axis_x;
  vec3 axis_y;
  vec3 axis_z;
  vec3 half_extents;  // m, > 0, along each axis
};

#ifdef __cplusplus
static_assert(sizeof(OrientedBox) == 60);
}  // namespace lamp::shared
#endif

#endif
