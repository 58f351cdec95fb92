// Sums for automatic_exposure() (image/tone_map.cpp): of logarithms of luminance, and of coverage, over a group's
// pixels. One thread adds them up, in the same order in every run.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/luminance.glsl"

layout(local_size_x = 16, local_size_y = 16) in;
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D hdr_image;
layout(set = 0, binding = 1, std430) writeonly buffer SumBuffer { vec2 sums[]; };

shared vec2 s_parts[256];

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  vec2 part = vec2(0.0);
  if (all(lessThan(pixel, imageSize(hdr_image)))) {
    const vec4 color = imageLoad(hdr_image, pixel);
    const float luminance = luminance_of(color.rgb);
    if (color.a > 0.0 && luminance > 0.0 && !isinf(luminance)) part = color.a * vec2(log(luminance), 1.0);
  }
  s_parts[gl_LocalInvocationIndex] = part;
  barrier();  // all parts are there
  if (gl_LocalInvocationIndex != 0u) return;
  vec2 sum = vec2(0.0);
  for (uint i = 0u; i < 256u; ++i) sum += s_parts[i];
  sums[gl_WorkGroupID.x + gl_NumWorkGroups.x * gl_WorkGroupID.y] = sum;
}
