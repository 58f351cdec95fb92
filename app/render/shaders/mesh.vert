// Vertices of the scene's meshes, for every pass: the position is invariant, so that depths of all passes are equal.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lamplight/shared/frame.h"
#include "scene_data.h"

layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frame; };
layout(set = 0, binding = 2, scalar) readonly buffer InstanceBuffer { InstanceData instances[]; };

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec2 uv0;
layout(location = 4) in vec2 uv1;
layout(location = 5) in vec4 color;

layout(location = 0) out vec3 out_normal;
layout(location = 1) out vec4 out_tangent;
layout(location = 2) out vec2 out_uv0;
layout(location = 3) out vec2 out_uv1;
layout(location = 4) out vec4 out_color;
layout(location = 5) flat out uint out_triangle;  // of its first corner, where a scene's triangles are numbered
invariant gl_Position;

void main() {
  const InstanceData instance = instances[gl_InstanceIndex];
  const vec4 world = instance.world_from_object * vec4(position, 1.0);
  gl_Position = frame.clip_from_view * (frame.view_from_world * world);
  out_normal = mat3(instance.normal_x, instance.normal_y, instance.normal_z) * normal;
  out_tangent = vec4(mat3(instance.world_from_object) * tangent.xyz, tangent.w);
  out_uv0 = uv0;
  out_uv1 = uv1;
  out_color = color;
  out_triangle = instance.first_triangle + uint(gl_VertexIndex);
}
