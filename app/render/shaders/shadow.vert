// Vertices of shadow casters, each instance into one view of the atlas. A view is a viewport, and its scissor keeps what is
// drawn inside: to clip by all sides of a square takes hardware longer than to draw.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_ARB_shader_viewport_layer_array : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "scene_data.h"
#include "shadow_data.h"

layout(set = 0, binding = 2, scalar) readonly buffer InstanceBuffer { InstanceData instances[]; };
layout(set = 0, binding = 10, scalar) readonly buffer ViewBuffer { ShadowView views[]; };
layout(set = 0, binding = 11, scalar) readonly buffer CasterBuffer { ShadowCaster casters[]; };
layout(set = 0, binding = 12, scalar) readonly buffer PairBuffer { uint pairs[]; };
layout(push_constant) uniform Push { uint first_view; };

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
out float gl_ClipDistance[1];

// Two octants share a viewport, to either side of a plane. Their row_w is their signs, others' has length 1.
vec3 cut_of(ShadowView view) { return dot(view.row_w, view.row_w) > 2.0 ? view.planes[2] : view.row_w; }

void main() {
  const uint pair = pairs[gl_InstanceIndex];
  const ShadowView view = views[first_view + pair % VIEWS_A_DRAW];
  const InstanceData instance = instances[casters[pair / VIEWS_A_DRAW].instance];
  const vec3 rel = (instance.world_from_object * vec4(position, 1.0)).xyz - view.position;
  gl_Position = vec4(dot(view.row_x, rel), dot(view.row_y, rel), view.near_m, dot(view.row_w, rel));
  gl_ClipDistance[0] = dot(cut_of(view), rel) - APEX_SHARE * view.near_m;
  gl_ViewportIndex = int(pair % VIEWS_A_DRAW);
  // Of masked materials only colour and texture coordinates matter.
  out_normal = vec3(0.0);
  out_tangent = vec4(0.0);
  out_uv0 = uv0;
  out_uv1 = uv1;
  out_color = color;
}
