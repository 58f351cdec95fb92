// Standard deferred: one light for the pixels of its volume; blending adds it up.
// Based on: Stewart, Compute-Based Tiled Culling, GPU Pro 7 (2016), 1.5.1.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lamplight/shared/frame.h"

layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frame; };
#include "common/deferred_surface.glsl"
#include "common/lights.glsl"

layout(location = 0) flat in uint in_light;
layout(location = 0) out vec4 out_color;

void main() {
  const ivec2 pixel = ivec2(gl_FragCoord.xy);
  const float depth = texelFetch(depth_image, pixel, 0).x;
  if (is_sky(frame, depth)) discard;
  shadow_seed = seed_of_pixel(uvec2(pixel));
  const Surface s = read_surface(pixel, z_view_of(frame, depth));
  vec3 sum = vec3(0.0);
  add_light(sum, reflector(s), in_light);
  out_color = vec4(sum, 0.0);
}
