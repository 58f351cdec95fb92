// Walks the look-up through every pixel at one depth, whatever lies there (visit.comp).
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
layout(set = 0, binding = 2, scalar) writeonly buffer MetBuffer { Met met[]; };
layout(push_constant) uniform Push {
  float z_view;   // m ahead
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
  if (any(greaterThanEqual(pixel, frame.size_px))) return;
  Met found = Met(0u, lookup_cell(pixel, z_view), 0u, 0u, 0u, 0u);
  uint light;
  LOOKUP_EACH_IN(light, pixel, z_view, first_id, end_id) {
    ++found.visited;
    found.hash = (found.hash ^ light) * 16777619u;  // FNV-1a, a light at a time
  }
  if (loops_ended(two)) found.ended = 1u;
  met[pixel.x + frame.size_px.x * pixel.y] = found;
}
