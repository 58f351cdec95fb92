// Marks, for every cell, the places of its list whose light surely reaches one of its pixels.
// Promise: one bit a place; the cell's pixels must walk one and the same list, which the host has made sure of.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/surely_reaches.glsl"

layout(local_size_x_id = 0, local_size_y_id = 1) in;
layout(set = 0, binding = 5, scalar) readonly buffer PlaceBuffer { uint first_places[]; };
layout(set = 0, binding = 6, scalar) buffer MarkBuffer { uint marks[]; };
layout(push_constant) uniform Push {
  uint buffer_row;  // of the picture: the first of `first_places`
  uint first_row;   // rows to look at
  uint rows;
  uint origin_row;  // of the dispatch
};
#include "common/shown_view.glsl"
#include "lookup.glsl"
#include "lookup/parts/each.glsl"
#include "common/atomic_load.glsl"
#include "common/frame.glsl"

void main() {
  lookup_prepare();
  const uvec2 pixel = gl_GlobalInvocationID.xy + uvec2(0u, origin_row);
  if (any(greaterThanEqual(pixel, frame.size_px)) || pixel.y < first_row || pixel.y >= first_row + rows) return;
  const float depth = texelFetch(depth_image, ivec2(pixel), 0).x;
  if (is_sky(frame, depth)) return;
  const float z_view = z_view_of(frame, depth);
  const dvec3 position = exact_world_position(pixel, depth);
  uint place = first_places[(pixel.y - buffer_row) * frame.size_px.x + pixel.x];
  uint light;
  LOOKUP_EACH(light, pixel, z_view) {
    const uint bit = 1u << (place % 32u);
    const uint word = place / 32u;
    ++place;
    // Most are marked already, and an atomic is dear.
    if ((LOAD_OF_DEVICE(marks[word]) & bit) != 0u) continue;
    if (light < light_count_of(frame) && surely_reaches(light, position)) atomicOr(marks[word], bit);
  }
}
