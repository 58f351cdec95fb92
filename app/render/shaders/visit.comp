// Walks the look-up of every pixel and writes down what it met, of the oracle's lights too.
// Promise: sees exactly what shading sees, because it reads through the same look-up. Its loops are the walk's alone, so
// that a device which ends loops ends them where it ends the walk.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#include "lamplight/shared/frame.h"
#include "scene_data.h"

layout(local_size_x_id = 0, local_size_y_id = 1) in;
layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frame; };
layout(set = 0, binding = 1) uniform texture2D depth_image;
layout(set = 0, binding = 2, scalar) readonly buffer OffsetBuffer { uint truth_offsets[]; };
layout(set = 0, binding = 3, scalar) readonly buffer TruthBuffer { uint truth[]; };
layout(set = 0, binding = 4, scalar) writeonly buffer MetBuffer { Met met[]; };
layout(push_constant) uniform Push {
  uint first_pixel;  // pixels to answer for, numbered row by row
  uint end_pixel;
  uint first_id;  // entities to answer for
  uint end_id;
  uint two;  // for loops_ended
};
#include "common/loops_ended.glsl"
#include "common/shown_view.glsl"
#include "lookup.glsl"
#include "lookup/parts/each.glsl"
#include "common/frame.glsl"

void main() {
  lookup_prepare();
  const uvec2 pixel = gl_GlobalInvocationID.xy;
  const uint number = pixel.x + frame.size_px.x * pixel.y;
  if (any(greaterThanEqual(pixel, frame.size_px)) || number < first_pixel || number >= end_pixel) return;
  const uint index = number - first_pixel;
  const float depth = texelFetch(depth_image, ivec2(pixel), 0).x;
  if (is_sky(frame, depth)) {
    met[index] = Met(0u, SKY_CELL, 0u, 0u, 0u, 0u);
    return;
  }
  const float z_view = z_view_of(frame, depth);
  const uint begin = truth_offsets[index];
  const uint end = truth_offsets[index + 1u];
  uint next = begin;
  Met found = Met(0u, lookup_cell(pixel, z_view), 0u, 0u, 0u, 0u);
  uint last = 0u;
  uint light;
  LOOKUP_EACH_IN(light, pixel, z_view, first_id, end_id) {
    if (found.visited > 0u && light <= last) found.unordered = 1u;
    last = light;
    ++found.visited;
    found.hash = (found.hash ^ light) * 16777619u;  // FNV-1a, a light at a time
    if (next < end && truth[next] == light) ++next;
  }
  found.in_order = next - begin;
  if (loops_ended(two)) found.ended = 1u;
  met[index] = found;
}
