// What walks.comp does, as an engine would say it in HLSL.
// SPDX-License-Identifier: Apache-2.0
[[vk::constant_id(2)]] const uint VIEW = 0;
static uint view = 0;  // glslang ends where a specialization constant is an index
#define LOOKUP_VIEW view
#include "lookup.hlsl"
#include "lookup/parts/each.glsl"
#include "common/frame.hlsl"
#include "walks_hash.glsl"

[[vk::binding(1, 0)]] RWStructuredBuffer<uint> words;

static const uint WORDS = 11;

[numthreads(8, 8, 1)]
void main(uint3 thread : SV_DispatchThreadID) {
  view = VIEW;
  lookup_prepare();
  const uint2 pixel = thread.xy;
  if (any(pixel >= lookup_frame.size_px)) return;
  const float z_view = z_view_of(lookup_frame, test_depth(pixel));
  const float3 position = world_position(lookup_frame, float2(pixel) + 0.5, z_view);
  const uint third = lookup_frame.light_count / 3;
  const uint first = WORDS * (pixel.x + lookup_frame.size_px.x * pixel.y);
  words[first] = lookup_cell(pixel, z_view);
  words[first + 1] = asuint(z_view);
  words[first + 2] = asuint(position.x);
  words[first + 3] = asuint(position.y);
  words[first + 4] = asuint(position.z);
  words[first + 5] = plain_hash(pixel, z_view);
  words[first + 6] = each_hash(pixel, z_view);
  words[first + 7] = each_in_hash(pixel, z_view, third, 2 * third);
  words[first + 8] = few_in_hash(pixel, z_view, third, 2 * third);
  words[first + 9] = taken_hash(pixel, z_view);
  words[first + 10] = by_type_hash(pixel, z_view);
}
