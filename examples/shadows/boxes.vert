// The boxes of the house.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "house.glsl"

layout(push_constant) uniform Push { mat4 clip_from_world; };
invariant gl_Position;  // depth is drawn before, with the same shader
layout(location = 0) out vec3 position;
layout(location = 1) flat out vec3 normal;
layout(location = 2) flat out uint material;

void main() {
  const Box box = house_box(uint(gl_InstanceIndex));
  position = box_position(box, uint(gl_VertexIndex));
  normal = box_normal(uint(gl_VertexIndex));
  material = box.material;
  gl_Position = clip_from_world * vec4(position, 1.0);
}
