// Forward shading of the boxes: walks the lights of the position, as particles do.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lookup/world_cells.glsl"  // lamplight
#include "surface.glsl"

void main() {
  const vec3 albedo = albedo_of(material);
  target = vec4(0.0);
  uint light;
  for (Walk walk = world_walk_begin(position); world_walk_next(walk, light);)  // lamplight
    target += vec4(albedo * light_on(lights[light], position, normal), 1.0);
}
