// Forward shading: walks the lights of the pixel.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// lamplight {
#include "lookup/cell_lists.glsl"
#include "common/frame.glsl"
// }
#include "surface.glsl"

void main() {
  const vec3 albedo = textured_albedo();
  target = vec4(0.0);
  uint light;
  // lamplight {
  const float z_view = z_view_of(lookup_frame, gl_FragCoord.z);
  for (Walk walk = walk_begin(uvec2(gl_FragCoord.xy), z_view); walk_next(walk, light);)
    // }
    target += vec4(albedo * light_on(lights[light], position, normal), 1.0);
}
