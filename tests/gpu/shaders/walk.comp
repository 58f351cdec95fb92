// What an engine's shader does with a look-up: walks the lights of each pixel; here it notes them, one bit a light.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#include "lamplight/shared/frame.h"

layout(local_size_x_id = 0, local_size_y_id = 1) in;
layout(constant_id = 2) const uint VIEW = 0;
#define LOOKUP_VIEW VIEW
layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frame; };
#define LOOKUP_POSITION_FRAME(view) frame  // of the sample whose depth this is
layout(set = 0, binding = 1) uniform texture2D depth_image;
layout(set = 0, binding = 2, scalar) writeonly buffer MaskBuffer { uvec2 masks[]; };
#include "lookup.glsl"
#include "common/frame.glsl"

void main() {
  lookup_prepare();
  const uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, frame.size_px))) return;
  const float depth = texelFetch(depth_image, ivec2(pixel), 0).x;
  uvec2 mask = uvec2(0u);
  uint light;
  if (!is_sky(frame, depth))
    for (Walk walk = walk_begin(pixel, z_view_of(frame, depth)); walk_next(walk, light);)
      mask[light / 32u] |= 1u << (light % 32u);
  masks[pixel.x + frame.size_px.x * pixel.y] = mask;
}
