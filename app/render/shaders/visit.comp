// Walks the look-up of every pixel and writes down what it found; against the oracle's lists, what it missed.
// Promise: sees exactly what shading sees, because it reads through the same look-up.
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
layout(set = 0, binding = 4, scalar) writeonly buffer VisitBuffer { Visit visits[]; };
layout(push_constant) uniform Push {
  uint first_row;  // rows to answer for
  uint rows;
  uint first_id;  // entities to answer for
  uint end_id;
};
#include "lookup.glsl"
#include "lookup/parts/each.glsl"
#include "common/frame.glsl"

const uint NONE = ~0u;

// Which of up to 32 of the oracle's lights a walk brings, one bit each. Walks are few, because software devices end a
// thread's loops after some 65 000 rounds.
uint walk_brings(uvec2 pixel, float z_view, uint first, uint count) {
  uint brought = 0u;
  uint light;
  LOOKUP_EACH_IN(light, pixel, z_view, first_id, end_id) {
    uint i = 0u;  // the last of them that is not greater, or the first
    for (uint step = 16u; step > 0u; step /= 2u)
      if (i + step < count && truth[first + i + step] <= light) i += step;
    if (truth[first + i] == light) brought |= 1u << i;
  }
  return brought;
}

// An ascending walk meets all of the oracle's lights in passing. If it does not, each of them is searched.
void main() {
  lookup_prepare();
  const uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, frame.size_px)) || pixel.y < first_row || pixel.y >= first_row + rows) return;
  const uint index = (pixel.y - first_row) * frame.size_px.x + pixel.x;
  const float depth = texelFetch(depth_image, ivec2(pixel), 0).x;
  if (depth <= 0.0) {
    visits[index] = Visit(0u, SKY_CELL, 0u, NONE, 0u, 0u);
    return;
  }
  const float z_view = z_view_of(frame, depth);
  const uint end = truth_offsets[index + 1u];
  uint next = truth_offsets[index];
  Visit visit = Visit(0u, lookup_cell(pixel, z_view), 0u, NONE, 0u, 0u);
  uint last = 0u;
  uint light;
  LOOKUP_EACH_IN(light, pixel, z_view, first_id, end_id) {
    if (visit.visited > 0u && light <= last) visit.unordered = 1u;
    last = light;
    ++visit.visited;
    visit.hash = (visit.hash ^ light) * 16777619u;  // FNV-1a, a light at a time
    if (next < end && truth[next] == light) ++next;
  }
  for (uint first = next; first < end; first += 32u) {
    const uint count = min(32u, end - first);
    const uint lost = ~walk_brings(pixel, z_view, first, count) & (~0u >> (32u - count));
    visit.missed += bitCount(lost);
    if (lost != 0u) visit.first_missed = min(visit.first_missed, truth[first + uint(findLSB(lost))]);
  }
  visits[index] = visit;
}
