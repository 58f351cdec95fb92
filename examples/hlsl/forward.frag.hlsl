// Forward shading: walks the lights of the pixel's cluster.
// SPDX-License-Identifier: Apache-2.0
// lamplight {
#include "lookup/cluster_lists.hlsl"
#include "common/frame.hlsl"
// }
#include "surface.hlsl"

float4 main(Surface surface) : SV_Target {
  float3 color = float3(0, 0, 0);
  uint walked = 0;
  uint light;
  // lamplight {
  const float z_view = z_view_of(lookup_frame, surface.pixel.z);
  for (Walk walk = walk_begin(uint2(surface.pixel.xy), z_view); walk_next(walk, light);) {
    // }
    color += light_on(lights[light], surface);
    walked += 1;
  }
  return float4(color, float(walked));
}
