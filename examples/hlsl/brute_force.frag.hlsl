// The same picture from all lights, to compare with.
// SPDX-License-Identifier: Apache-2.0
#include "common/frame.hlsl"
#include "surface.hlsl"
[[vk::push_constant]] cbuffer Push {
  row_major float4x4 clip_from_world;
  uint light_count;
};

float4 main(Surface surface) : SV_Target {
  float3 color = float3(0, 0, 0);
  for (uint light = 0; light < light_count; ++light) color += light_on(lights[light], surface);
  return float4(color, float(light_count));
}
