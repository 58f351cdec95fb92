// Writes the G-buffer, and the number of the triangle that a pixel shows: what lists of triangles are asked with.
// Based on: Burns, Hunt, The Visibility Buffer: A Cache-Friendly Approach to Deferred Shading, JCGT 2:2 (2013), of which
// this keeps the number alone.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/write_gbuffer.glsl"

layout(location = 5) flat in uint in_triangle;
layout(location = 3) out uint out_triangle;

void main() {
  write_gbuffer();
  out_triangle = in_triangle;
}
