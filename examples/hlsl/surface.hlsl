// What the pixel shaders have in common: the surface, the light buffer, the lighting. The lights are Lamplight's 64-byte
// records; include this behind a file of Lamplight's that ends in .hlsl.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/shared/light.h"  // lamplight

struct Surface {
  float4 pixel : SV_Position;
  float3 position : POSITION;
  nointerpolation float3 normal : NORMAL;
  nointerpolation float3 albedo : COLOR;
};
[[vk::binding(1, 0)]] StructuredBuffer<Light> lights;

// KHR_lights_punctual, with a bound near the light: exactly 0 from the range on and outside of the cone.
float3 light_on(Light light, Surface surface) {
  const float3 way = light.position - surface.position;
  const float distance_m = length(way);
  const float share = distance_m / light.range;
  const float window = max(1.0 - share * share * share * share, 0.0);
  const float3 to_light = way / max(distance_m, 1e-4);
  float cone = 1.0;
  if (light.type == LIGHT_SPOT) {
    cone = saturate((dot(-to_light, light.direction) - light.cos_outer) * light.spot_scale);
    cone *= cone;
  }
  const float facing = max(dot(surface.normal, to_light), 0.0);
  return light.intensity * surface.albedo * (window * cone * facing / (distance_m * distance_m + 0.05));
}
