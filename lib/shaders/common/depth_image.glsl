// The depth image: of one sample a pixel, or of several in shaders that are compiled a second time, with MULTISAMPLED
// (cmake/LamplightShaders.cmake). A light that reaches any sample of a pixel is listed. And keys of depths, which sort
// alike whichever way depth runs.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_DEPTH_IMAGE
#define LAMP_COMMON_DEPTH_IMAGE
#extension GL_EXT_samplerless_texture_functions : require
#include "common/frame.glsl"

// The key of a device depth, which is in 0..1, from its bits: the sky's is the least, the nearest depth's the greatest.
// The same function turns a key into the bits of its depth.
const uint SKY_KEY = 0u;
uint depth_key(Frame frame, uint bits) { return uint(abs(int(bits) - int(frame.sky_bits))); }

float z_view_of_key(Frame frame, uint key) { return z_view_of(frame, uintBitsToFloat(depth_key(frame, key))); }

#ifdef MULTISAMPLED
#define DepthImage texture2DMS
#define DepthSquares texture2DMS
uint samples_of(DepthImage depth_image) { return uint(textureSamples(depth_image)); }
float depth_at(Frame frame, DepthImage depth_image, uvec2 pixel, uint one_sample) {
  return texelFetch(depth_image, ivec2(pixel + frame.depth_offset_px), int(one_sample)).x;
}
#else
#define DepthImage texture2D
#define DepthSquares sampler2D  // to be gathered
uint samples_of(DepthImage depth_image) { return 1u; }
float depth_at(Frame frame, DepthImage depth_image, uvec2 pixel, uint one_sample) {
  return texelFetch(depth_image, ivec2(pixel + frame.depth_offset_px), 0).x;
}
#endif

// The key of a pixel's sample; that of sky beyond the picture, whatever a larger image holds there.
uint depth_key_at(Frame frame, DepthImage depth_image, uvec2 pixel, uint one_sample) {
  if (any(greaterThanEqual(pixel, frame.size_px))) return SKY_KEY;
  return depth_key(frame, floatBitsToUint(depth_at(frame, depth_image, pixel, one_sample)));
}

#endif
