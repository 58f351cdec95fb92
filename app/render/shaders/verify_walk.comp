// Walks the look-up of every pixel and holds it against the truth of verify_truth.comp.
// Promise: sees exactly what shading sees, because it reads through the same look-up.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/surely_reaches.glsl"

layout(local_size_x_id = 0, local_size_y_id = 1) in;
layout(set = 0, binding = 5, scalar) readonly buffer TruthBuffer { PixelTruth truth[]; };
layout(set = 0, binding = 6, scalar) writeonly buffer SurveyBuffer { Survey surveys[]; };
layout(push_constant) uniform Push {
  uint buffer_row;  // of the picture: the buffers' first
  uint first_row;   // rows to answer for
  uint rows;
  uint origin_row;  // of the dispatch
};
#include "lookup.glsl"
#include "lookup/parts/each.glsl"
#include "common/frame.glsl"

const uint NONE = ~0u;

bool reaches(uint light, dvec3 position) { return light < frame.light_count && surely_reaches(light, position); }

// The distinct lights of a walk that reach: the next four by index, walk after walk, until there are no more. For lists
// in any order that do not hold the truth; walks are few, because software devices end a thread's loops after some
// 65 000 rounds.
PixelTruth distinct(uvec2 pixel, float z_view, dvec3 position) {
  PixelTruth found = PixelTruth(0u, uvec2(0u));
  for (uint next = 0u; next != NONE;) {
    uvec4 least = uvec4(NONE);
    uint light;
    LOOKUP_EACH(light, pixel, z_view) {
      if (light < next || any(equal(least, uvec4(light))) || !reaches(light, position)) continue;
      for (uint i = 0u; i < 4u; ++i) {
        const uint larger = max(least[i], light);
        least[i] = min(least[i], light);
        light = larger;
      }
    }
    for (uint i = 0u; i < 4u; ++i)
      if (least[i] != NONE) {
        ++found.count;
        found.hash += hash_of(least[i]);
      }
    next = least.w == NONE ? NONE : least.w + 1u;
  }
  return found;
}

void main() {
  lookup_prepare();
  const uvec2 pixel = gl_GlobalInvocationID.xy + uvec2(0u, origin_row);
  if (any(greaterThanEqual(pixel, frame.size_px)) || pixel.y < first_row || pixel.y >= first_row + rows) return;
  const uint index = (pixel.y - buffer_row) * frame.size_px.x + pixel.x;
  const float depth = texelFetch(depth_image, ivec2(pixel), 0).x;
  if (depth <= 0.0) {
    surveys[index] = Survey(0u, SKY_CELL, 0u, 0u, 0u, 0u, 0u);
    return;
  }
  const float z_view = z_view_of(frame, depth);
  const dvec3 position = exact_world_position(pixel, depth);
  const PixelTruth wanted = truth[index];
  Survey survey = Survey(0u, lookup_cell(pixel, z_view), wanted.count, 0u, 0u, 0u, 0u);
  PixelTruth found = PixelTruth(0u, uvec2(0u));
  uint last = 0u;
  uint light;
  LOOKUP_EACH(light, pixel, z_view) {
    if (survey.visited > 0u && light <= last) survey.unordered = 1u;
    last = light;
    ++survey.visited;
    survey.list += hash_of(light).x;
    if (reaches(light, position)) {
      ++found.count;
      found.hash += hash_of(light);
    }
  }
  if (survey.unordered != 0u && found != wanted) {
    const uint walked = found.count;
    found = distinct(pixel, z_view, position);
    survey.repeated = walked - found.count;
  }
  // Lists that differ by more than misses cannot be: a walk's lights are tested as the truth's are.
  if (found != wanted) survey.missed = max(wanted.count, found.count + 1u) - found.count;
  surveys[index] = survey;
}
