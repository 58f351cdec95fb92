// One triangle, counter-clockwise on the screen, over the part of the viewport left of and above the diagonal.
// SPDX-License-Identifier: Apache-2.0
#version 460

void main() {
  const vec2 corners[3] = vec2[](vec2(-1.0, -1.0), vec2(-1.0, 1.0), vec2(1.0, -1.0));
  gl_Position = vec4(corners[gl_VertexIndex % 3], 0.5, 1.0);
}
