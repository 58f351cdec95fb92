// As the renderer's still_walk.comp, in HLSL.
// SPDX-License-Identifier: Apache-2.0
#include "world/triangle_lists.hlsl"

[[vk::binding(0, 0)]] StructuredBuffer<uint4> points;  // position, triangle
[[vk::binding(1, 0)]] RWStructuredBuffer<uint2> walks;
struct Push {
  uint point_count;
};
[[vk::push_constant]] ConstantBuffer<Push> push;

[numthreads(64, 1, 1)] void main(uint3 thread : SV_DispatchThreadID) {
  if (thread.x >= push.point_count) return;
  const uint4 at = points[thread.x];
  uint2 met = uint2(0u, 2166136261u);
  uint light;
  TriangleWalk walk = triangle_walk_begin(at.w, asfloat(at.xyz));
  while (triangle_walk_next(walk, light)) {
    ++met.x;
    met.y = (met.y ^ light) * 16777619u;
  }
  walks[thread.x] = met;
}
