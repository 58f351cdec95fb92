// What a look-up says at each pixel, walked in every way that it knows, and positions of common/frame.glsl: words that
// walks.comp.hlsl, which is the same in HLSL, must write too.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#include "lamplight/shared/frame.h"

layout(local_size_x_id = 0, local_size_y_id = 1) in;
layout(constant_id = 2) const uint VIEW = 0;
#define LOOKUP_VIEW VIEW
layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) writeonly buffer WordBuffer { uint words[]; };
#include "lookup.glsl"
#include "lookup/parts/each.glsl"
#include "common/frame.glsl"
#include "walks_hash.glsl"

const uint WORDS = 11u;

void main() {
  lookup_prepare();
  const uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, frame.size_px))) return;
  const float z_view = z_view_of(frame, test_depth(pixel));
  const vec3 position = world_position(frame, vec2(pixel) + 0.5, z_view);
  const uint third = frame.light_count / 3u;
  const uint first = WORDS * (pixel.x + frame.size_px.x * pixel.y);
  words[first] = lookup_cell(pixel, z_view);
  words[first + 1u] = floatBitsToUint(z_view);
  words[first + 2u] = floatBitsToUint(position.x);
  words[first + 3u] = floatBitsToUint(position.y);
  words[first + 4u] = floatBitsToUint(position.z);
  words[first + 5u] = plain_hash(pixel, z_view);
  words[first + 6u] = each_hash(pixel, z_view);
  words[first + 7u] = each_in_hash(pixel, z_view, third, 2u * third);
  words[first + 8u] = few_in_hash(pixel, z_view, third, 2u * third);
  words[first + 9u] = taken_hash(pixel, z_view);
  words[first + 10u] = by_type_hash(pixel, z_view);
}
