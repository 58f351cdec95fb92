// What count_clustered.comp does, in HLSL: for the method `clustered`, with all bindings in set 1 and the look-up's right
// behind the engine's own.
// SPDX-License-Identifier: Apache-2.0
#define LOOKUP_SET 1
#define LOOKUP_FIRST_BINDING 3
#define LOOKUP_FIRST_CONSTANT 0
#include "lookup/cluster_lists.hlsl"
#include "common/frame.hlsl"
#include "lamplight/shared/light.h"

[[vk::binding(0, 1)]] Texture2D<float> depth_image;
[[vk::binding(1, 1)]] StructuredBuffer<Light> lights;
[[vk::binding(2, 1)]] RWStructuredBuffer<uint2> counts;  // reached, walked

bool reaches(Light light, float3 position) {
  const float3 to_position = position - light.position;
  const float distance_m = length(to_position);
  if (distance_m >= light.range) return false;
  return light.type == LIGHT_POINT || dot(to_position, light.direction) > light.cos_outer * distance_m;
}

[numthreads(8, 8, 1)]
void main(uint3 thread : SV_DispatchThreadID) {
  const uint2 pixel = thread.xy;
  const uint2 size_px = lookup_frame.size_px;
  if (any(pixel >= size_px)) return;
  const float depth = depth_image.Load(int3(pixel, 0));
  uint2 count = uint2(0, 0);
  if (depth > 0.0) {
    const float z_view = z_view_of(lookup_frame, depth);
    const float3 position = world_position(lookup_frame, float2(pixel) + 0.5, z_view);
    uint light;
    for (Walk walk = walk_begin(pixel, z_view); walk_next(walk, light);) {
      count.y += 1;
      if (reaches(lights[light], position)) count.x += 1;
    }
  }
  counts[pixel.x + size_px.x * pixel.y] = count;
}
