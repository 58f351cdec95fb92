// Deferred shading of an eye: walks the lights of the pixel.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "eye.glsl"
// lamplight {
#define LOOKUP_VIEW eye
#include "lookup/tile_lists.glsl"
#include "common/frame.glsl"
// }

void main() {
  const uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, size_px))) return;
  const float depth = texelFetch(surface_and_depth[1], ivec2(pixel), 0).x;
  const vec4 surface = texelFetch(surface_and_depth[0], ivec2(pixel), 0);
  vec4 sum = vec4(0.0);  // w: lights that were walked
  if (depth > 0.0) {
    const vec3 position = position_of(pixel, depth);
    const vec3 albedo = albedo_of(uint(surface.w));
    uint light;
    // lamplight {
    const float z_view = z_view_of(lookup_frame, depth);
    for (Walk walk = walk_begin(pixel, z_view); walk_next(walk, light);)
      // }
      sum += vec4(albedo * light_on(lights[light], position, surface.xyz), 1.0);
  }
  picture[pixel.y * size_px.x + pixel.x] = sum;
}
