// Deferred paths: paints decals into the G-buffer, before anything lights it. What it read was copied before.
// Based on: Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017): entities of all kinds
// in one structure.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lamplight/shared/frame.h"

layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frame; };
#include "common/shown_view.glsl"
#include "lookup.glsl"
#include "common/deferred_surface.glsl"
#include "common/decals.glsl"

layout(location = 0) out vec4 out_base_color;
layout(location = 1) out uvec2 out_surface;

void main() {
  const ivec2 pixel = ivec2(gl_FragCoord.xy);
  const float depth = texelFetch(depth_image, pixel, 0).x;
  if (is_sky(frame, depth)) discard;
  const float z_view = z_view_of(frame, depth);
  Surface s = read_surface(pixel, z_view);
  if (!apply_decals(s, uvec2(pixel), z_view)) discard;
  out_base_color = vec4(s.base_color, 1.0);
  out_surface = uvec2(packSnorm2x16(octahedral(s.normal)), texelFetch(surface_image, pixel, 0).y);
}
