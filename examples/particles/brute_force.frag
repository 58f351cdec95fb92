// The same boxes from all lights, to compare with.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "surface.glsl"

void main() {
  const vec3 albedo = albedo_of(material);
  target = vec4(0.0);
  for (uint light = 0u; light < lights.length(); ++light)
    target += vec4(albedo * light_on(lights[light], position, normal), 1.0);
}
