// Counts what verify_walk.comp cannot: of lists that are out of order and do not hold the truth, the lights that they
// miss and those that they bring again. Each pixel marks the reaching lights of its walk, a bit for each.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/surely_reaches.glsl"

layout(local_size_x_id = 0, local_size_y_id = 1) in;
layout(set = 0, binding = 5, scalar) buffer SurveyBuffer { Survey surveys[]; };
layout(set = 0, binding = 6, scalar) buffer MarkBuffer { uint marks[]; };  // all 0, whole words for each pixel
layout(push_constant) uniform Push {
  uint buffer_row;   // of the picture: the first of `surveys`
  uint first_pixel;  // pixels to look at, numbered row by row
  uint end_pixel;
  uint origin_row;  // of the dispatch
};
#include "common/shown_view.glsl"
#include "lookup.glsl"
#include "lookup/parts/each.glsl"
#include "common/frame.glsl"

void main() {
  lookup_prepare();
  const uvec2 pixel = gl_GlobalInvocationID.xy + uvec2(0u, origin_row);
  const uint number = pixel.x + frame.size_px.x * pixel.y;
  if (any(greaterThanEqual(pixel, frame.size_px)) || number < first_pixel || number >= end_pixel) return;
  const uint index = number - frame.size_px.x * buffer_row;
  if (surveys[index].missed != NOT_COUNTED) return;
  const float depth = texelFetch(depth_image, ivec2(pixel), 0).x;
  const float z_view = z_view_of(frame, depth);
  const dvec3 position = exact_world_position(pixel, depth);
  const uint base = (number - first_pixel) * ((light_count_of(frame) + 31u) / 32u);
  uint distinct = 0u;
  uint repeated = 0u;
  uint light;
  LOOKUP_EACH(light, pixel, z_view) {
    if (light >= light_count_of(frame) || !surely_reaches(light, position)) continue;
    const uint word = base + light / 32u;
    const uint bit = 1u << (light % 32u);
    const uint before = marks[word];
    marks[word] = before | bit;
    distinct += (before & bit) == 0u ? 1u : 0u;
    repeated += (before & bit) == 0u ? 0u : 1u;
  }
  surveys[index].missed = surveys[index].useful - distinct;
  surveys[index].repeated = repeated;
}
