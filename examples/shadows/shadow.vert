// The boxes of the house once for each view of the shadow atlas.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "house.glsl"
#include "lamplight/shared/shadow.h"  // lamplight

layout(set = 0, binding = 1, scalar) readonly buffer ViewBuffer { ShadowView views[]; };  // lamplight
out float gl_ClipDistance[4];

void main() {
  const uint instance = uint(gl_InstanceIndex);
  const vec3 world = box_position(house_box(instance % HOUSE_BOXES), uint(gl_VertexIndex));
  // lamplight {
  const ShadowView view = views[instance / HOUSE_BOXES];
  const vec3 rel = world - view.position;
  gl_Position = vec4(dot(view.row_x, rel), dot(view.row_y, rel), view.near_m, dot(view.row_w, rel));
  for (uint i = 0u; i < 4u; ++i) gl_ClipDistance[i] = dot(view.planes[i], rel);
  // }
}
