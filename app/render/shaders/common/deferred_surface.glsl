// Reads a pixel of the G-buffer back into a surface.
// Needs: `frame`.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_DEFERRED_SURFACE
#define LAMP_DEFERRED_SURFACE
#extension GL_EXT_samplerless_texture_functions : require
#include "common/brdf.glsl"
#include "common/eye.glsl"
#include "common/frame.glsl"
#include "common/gbuffer.glsl"

layout(set = 0, binding = 1) uniform texture2D depth_image;
layout(set = 0, binding = 5) uniform texture2D base_color_image;
layout(set = 0, binding = 6) uniform utexture2D surface_image;
layout(set = 0, binding = 7) uniform texture2D emission_image;

Surface read_surface(ivec2 pixel, float z_view) {
  const uvec2 stored = texelFetch(surface_image, pixel, 0).xy;
  const vec4 factors = unpackUnorm4x8(stored.y);
  Surface s;
  s.position = world_position(frame, vec2(pixel) + 0.5, z_view);
  s.normal = from_octahedral(stored.x);
  s.to_eye = to_eye(frame, s.position);
  s.base_color = texelFetch(base_color_image, pixel, 0).rgb;
  s.metallic = factors.x;
  s.roughness = max(factors.y, 0.045);
  s.occlusion = factors.z;
  return s;
}

#endif
