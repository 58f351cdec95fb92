// Walks the look-up of some pixels and marks the lights that it brings, in any order and however often: a bit for each.
// For walks that do not meet the oracle's lights one after the other (visit.comp).
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#include "lamplight/shared/frame.h"

layout(local_size_x_id = 0, local_size_y_id = 1) in;
layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frame; };
layout(set = 0, binding = 1) uniform texture2D depth_image;
layout(set = 0, binding = 2, scalar) buffer MarkBuffer { uint marks[]; };  // whole words for each pixel
layout(push_constant) uniform Push {
  uint first_pixel;  // pixels to answer for, numbered row by row
  uint end_pixel;
  uint first_id;  // entities to walk
  uint end_id;
  uint end_mark;  // of them, those that have a mark: there may be ids that nobody has
};
#include "common/shown_view.glsl"
#include "lookup.glsl"
#include "lookup/parts/each.glsl"
#include "common/frame.glsl"

void main() {
  lookup_prepare();
  const uvec2 pixel = gl_GlobalInvocationID.xy;
  const uint number = pixel.x + frame.size_px.x * pixel.y;
  if (any(greaterThanEqual(pixel, frame.size_px)) || number < first_pixel || number >= end_pixel) return;
  const float depth = texelFetch(depth_image, ivec2(pixel), 0).x;
  if (is_sky(frame, depth)) return;
  const float z_view = z_view_of(frame, depth);
  const uint base = (number - first_pixel) * ((end_mark - first_id + 31u) / 32u);
  uint light;
  LOOKUP_EACH_IN(light, pixel, z_view, first_id, end_id) {
    const uint bit = light - first_id;
    if (light < end_mark) marks[base + bit / 32u] |= 1u << (bit % 32u);
  }
}
