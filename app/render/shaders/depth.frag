// Depth pre-pass of masked materials: cuts the holes.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/material.glsl"

void main() {
  if (is_cut_out(material_color().a)) discard;
}
