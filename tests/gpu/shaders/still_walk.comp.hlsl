// As the renderer's still_walk.comp, in HLSL.
// SPDX-License-Identifier: Apache-2.0
#include "world/triangle_lists.hlsl"
#define WORLD_TREE_WORD(word) triangle_words[word]  // the same buffer
#include "world/world_tree.hlsl"

[[vk::binding(0, 0)]] StructuredBuffer<uint4> points;  // position, triangle
[[vk::binding(1, 0)]] RWStructuredBuffer<uint2> walks;
[[vk::constant_id(19)]] const uint STILL_LISTS = 0u;  // as in still_data.h
struct Push {
  uint point_count;
};
[[vk::push_constant]] ConstantBuffer<Push> push;

uint2 meet(uint2 met, uint light) { return uint2(met.x + 1u, (met.y ^ light) * 16777619u); }

[numthreads(64, 1, 1)] void main(uint3 thread : SV_DispatchThreadID) {
  if (thread.x >= push.point_count) return;
  const uint4 at = points[thread.x];
  uint2 met = uint2(0u, 2166136261u);
  uint light;
  if (STILL_LISTS == 1u) {
    TriangleWalk walk = triangle_walk_begin(at.w, asfloat(at.xyz));
    while (triangle_walk_next(walk, light)) met = meet(met, light);
  }
  if (STILL_LISTS == 2u) {
    TreeWalk walk = tree_walk_begin(asfloat(at.xyz));
    while (tree_walk_next(walk, light)) met = meet(met, light);
  }
  walks[thread.x] = met;
}
