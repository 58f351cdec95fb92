// The same picture from all lights, to compare with.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "eye.glsl"

void main() {
  const uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, size_px))) return;
  const float depth = texelFetch(surface_and_depth[1], ivec2(pixel), 0).x;
  const vec4 surface = texelFetch(surface_and_depth[0], ivec2(pixel), 0);
  vec4 sum = vec4(0.0);
  if (depth > 0.0) {
    const vec3 position = position_of(pixel, depth);
    const vec3 albedo = albedo_of(uint(surface.w));
    for (uint light = 0u; light < light_count; ++light)
      sum += vec4(albedo * light_on(lights[light], position, surface.xyz), 1.0);
  }
  picture[pixel.y * size_px.x + pixel.x] = sum;
}
