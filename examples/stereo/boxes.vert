// The boxes of the scene, for both eyes in one draw call.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_multiview : require
#include "box.glsl"

layout(push_constant, scalar) uniform Push { mat4 clip_from_world[2]; };
layout(location = 0) flat out vec4 surface;  // normal, material

void main() {
  // Mesa 22.3 on the processor draws what comes first of the second view into the first one: a box without size.
  Box box = box_of(uint(max(gl_InstanceIndex - 1, 0)));
  if (gl_InstanceIndex == 0) box.half_extent = vec3(0.0);
  const uint vertex = uint(gl_VertexIndex);
  surface = vec4(box_normal(vertex), float(box.material));
  gl_Position = clip_from_world[gl_ViewIndex] * vec4(box_position(box, vertex), 1.0);
}
