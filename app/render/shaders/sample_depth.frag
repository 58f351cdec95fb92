// Copies a depth image of one sample a pixel into one sample of a larger image that has several.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_EXT_samplerless_texture_functions : require

layout(set = 0, binding = 0) uniform texture2D picture;
layout(push_constant) uniform Push {
  ivec2 offset_px;  // where the picture begins
  float beyond;     // the depth around it
};

void main() {
  const ivec2 pixel = ivec2(gl_FragCoord.xy) - offset_px;
  const bool inside = all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(pixel, textureSize(picture, 0)));
  gl_FragDepth = inside ? texelFetch(picture, pixel, 0).x : beyond;
}
