// Vertices of shadow casters, each instance into one view of the atlas: the square is part of the projection, and clip
// distances keep triangles inside it.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "scene_data.h"
#include "shadow_data.h"

layout(constant_id = 0) const uint VIEWS_A_BATCH = 1;
layout(set = 0, binding = 2, scalar) readonly buffer InstanceBuffer { InstanceData instances[]; };
layout(set = 0, binding = 10, scalar) readonly buffer ViewBuffer { ShadowView views[]; };
layout(set = 0, binding = 11, scalar) readonly buffer CasterBuffer { ShadowCaster casters[]; };
layout(set = 0, binding = 12, scalar) readonly buffer PairBuffer { uint pairs[]; };

// The tip of the view is cut off: a triangle in whose plane the light lies has w = 0 there, and is drawn anywhere.
// Beyond near_m that moves no side of the view by more than a hundredth of a texel.
const float APEX_SHARE = 1e-5;

layout(location = 0) in vec3 position;
layout(location = 3) in vec2 uv0;
layout(location = 4) in vec2 uv1;
layout(location = 5) in vec4 color;

layout(location = 0) out vec3 out_normal;
layout(location = 1) out vec4 out_tangent;
layout(location = 2) out vec2 out_uv0;
layout(location = 3) out vec2 out_uv1;
layout(location = 4) out vec4 out_color;
out float gl_ClipDistance[4];

void main() {
  const uint pair = gl_InstanceIndex;
  const uint view = pairs[pair];
  const InstanceData instance = instances[casters[pair / VIEWS_A_BATCH].instance];
  const vec3 rel = (instance.world_from_object * vec4(position, 1.0)).xyz - views[view].position;
  gl_Position = vec4(dot(views[view].row_x, rel), dot(views[view].row_y, rel), views[view].near_m,
                     dot(views[view].row_w, rel));
  for (uint i = 0u; i < 4u; ++i)
    gl_ClipDistance[i] = dot(views[view].planes[i], rel) - APEX_SHARE * views[view].near_m;
  // Of masked materials only colour and texture coordinates matter.
  out_normal = vec3(0.0);
  out_tangent = vec4(0.0);
  out_uv0 = uv0;
  out_uv1 = uv1;
  out_color = color;
}
