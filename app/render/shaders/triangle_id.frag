// The number of the triangle that a pixel shows, and 1: 0 is sky.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "common/material.glsl"

layout(location = 5) flat in uint in_triangle;
layout(location = 0) out uint out_triangle;

void main() {
  if (is_cut_out(material_color().a)) discard;
  out_triangle = in_triangle + 1u;
}
