// Forward shading: walks the lights of the pixel, and looks each one's shadow up.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lookup/cell_lists.glsl"  // lamplight
#include "surface.glsl"

void main() {
  const vec3 albedo = albedo_of(material);
  target = vec4(0.0);
  uint light;
  // lamplight {
  const float z_view = -(lookup_frame.view_from_world * vec4(position, 1.0)).z;
  for (Walk walk = walk_begin(uvec2(gl_FragCoord.xy), z_view); walk_next(walk, light);)
    // }
    target += vec4(albedo * shadowed_light(light), 1.0);
}
