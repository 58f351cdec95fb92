// An oriented box: what a decal or a reflection probe covers, for cells that hold more than lights. And how the record
// of a box tells culling its shape.
// Based on: Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017): structures of
// entities. Promise: 60 bytes in C++ and in GLSL.
// SPDX-License-Identifier: Apache-2.0
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

// A box's record in the light buffer is a point light (lamp::bounding_light), which leaves eight numbers unread. They
// tell its shape: `direction` and `outer_angle` are the unit quaternion x, y, z, w that turns the world's axes to the
// box's; `inner_angle`, `cos_outer` and `spot_scale` half extents (m) that enclose the box; `sin_outer` is one of
// these:
LAMP_CONST_FLOAT SHAPE_UNKNOWN = 0.0f;  // the sphere alone is known
LAMP_CONST_FLOAT SHAPE_BOX = 1.0f;
LAMP_CONST_FLOAT SHAPE_ELLIPSOID = 2.0f;

#ifdef __cplusplus
static_assert(sizeof(OrientedBox) == 60);
}  // namespace lamp::shared
#endif

#endif
