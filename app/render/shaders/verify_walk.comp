// Walks the look-up of every pixel and holds it against the truth of verify_truth.comp.
// Promise: sees exactly what shading sees, because it reads through the same look-up. Its loops are the walk's alone, so
// that a device which ends loops ends them where it ends the walk.
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
  uint two;         // for loops_ended
};
#include "common/loops_ended.glsl"
#include "common/shown_view.glsl"
#include "lookup.glsl"
#include "lookup/parts/each.glsl"
#include "common/frame.glsl"

bool reaches(uint light, dvec3 position) { return light < light_count_of(frame) && surely_reaches(light, position); }

void main() {
  lookup_prepare();
  const uvec2 pixel = gl_GlobalInvocationID.xy + uvec2(0u, origin_row);
  if (any(greaterThanEqual(pixel, frame.size_px)) || pixel.y < first_row || pixel.y >= first_row + rows) return;
  const uint index = (pixel.y - buffer_row) * frame.size_px.x + pixel.x;
  const float depth = texelFetch(depth_image, ivec2(pixel), 0).x;
  if (is_sky(frame, depth)) {
    surveys[index] = Survey(0u, SKY_CELL, 0u, 0u, 0u, 0u, 0u, 0u, 0u);
    return;
  }
  const float z_view = z_view_of(frame, depth);
  const dvec3 position = exact_world_position(pixel, depth);
  const PixelTruth wanted = truth[index];
  Survey survey = Survey(0u, lookup_cell(pixel, z_view), wanted.count, wanted.boundary, 0u, 0u, 0u, 0u, 0u);
  uint found = 0u;
  uvec2 hash = uvec2(0u);
  uint last = 0u;
  uint light;
  LOOKUP_EACH(light, pixel, z_view) {
    if (survey.visited > 0u && light <= last) survey.unordered = 1u;
    last = light;
    ++survey.visited;
    survey.list += hash_of(light).x;
    if (reaches(light, position)) {
      ++found;
      hash += hash_of(light);
    }
  }
  if (loops_ended(two)) survey.ended = 1u;
  // A list that ascends brings no light again, and reaching lights are of the truth: they are tested as the truth's are.
  if (survey.unordered == 0u)
    survey.missed = wanted.count - found;
  else if (found != wanted.count || hash != wanted.hash)
    survey.missed = NOT_COUNTED;
  surveys[index] = survey;
}
