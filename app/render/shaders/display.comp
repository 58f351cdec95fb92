// From radiance to what a screen shows: tone_map() of image/tone_map.cpp, and what is laid over the picture.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/luminance.glsl"

layout(local_size_x = 16, local_size_y = 16) in;
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D hdr_image;
layout(set = 0, binding = 1, rgba8) uniform writeonly image2D shown_image;
layout(set = 0, binding = 2, std430) readonly buffer OverlayBuffer { uint overlay[]; };  // RGBA, eight bits each
layout(push_constant) uniform Push {
  float exposure;
  uint first_x;     // columns that are written
  uint end_x;
  uint overlaid;    // 1: the overlay is laid over a grey picture, as far as its alpha says
};

const float BRIGHTEST = 1.0e4;

vec3 filmic(vec3 radiance) {
  const vec3 x = 0.13017 / 0.18 * min(max(radiance, 0.0), BRIGHTEST);
  return min(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 1.0);
}

vec3 srgb(vec3 linear) {
  return mix(1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, 12.92 * linear, lessThanEqual(linear, vec3(0.0031308)));
}

void main() {
  const uvec2 pixel = gl_GlobalInvocationID.xy;
  const uvec2 size = uvec2(imageSize(hdr_image));
  if (any(greaterThanEqual(pixel, size)) || pixel.x < first_x || pixel.x >= end_x) return;
  const vec3 radiance = imageLoad(hdr_image, ivec2(pixel)).rgb;
  vec3 shown = any(isnan(radiance)) ? vec3(1.0, 0.0, 1.0) : srgb(filmic(exposure * radiance));
  const vec4 over = overlaid != 0u ? unpackUnorm4x8(overlay[pixel.x + size.x * pixel.y]) : vec4(0.0);
  if (over.a > 0.0) shown = mix(vec3(luminance_of(shown)), over.rgb, over.a);
  imageStore(shown_image, ivec2(pixel), vec4(shown, 1.0));
}
