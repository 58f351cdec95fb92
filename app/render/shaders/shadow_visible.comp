// Which triangles of shadow casters a view's square may show: those whose bounds hold the centre of a texel. Most of a
// mesh's are smaller than a texel of the map or beside the square, and the rasterizer takes as long to drop one as to draw
// it. A group of threads takes a pair of caster and view, a thread one of its triangles.
// Based on: Wihlidal, Optimizing the Graphics Pipeline with Compute, GDC 2016: small primitive culling.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require
#include "common/shadow_triangle.glsl"

layout(local_size_x = 128) in;
layout(constant_id = 0) const uint VIEWS_A_BATCH = 1;
layout(set = 0, binding = 3, scalar) readonly buffer GroupBuffer { ShadowGroup groups[]; };
layout(set = 0, binding = 4, scalar) readonly buffer PairBuffer { uint pairs[]; };
layout(set = 0, binding = 5, scalar) buffer DrawBuffer { ShadowDraw draws[]; };
layout(set = 0, binding = 6, scalar) writeonly buffer ItemBuffer { uint items[]; };
layout(push_constant, scalar) uniform Push { ShadowDrawBatch batch; };

void list(bool shown, uint item) {
  const uvec4 all = subgroupBallot(shown);
  if (all == uvec4(0u)) return;
  uint place = 0u;
  if (subgroupElect()) place = atomicAdd(draws[batch.group].vertices, 3u * subgroupBallotBitCount(all));
  place = (draws[batch.group].first_vertex + subgroupBroadcastFirst(place)) / 3u + subgroupBallotExclusiveBitCount(all);
  if (shown) items[place] = item;
}

void main() {
  const uint first_pair = groups[batch.group].first_caster * VIEWS_A_BATCH;
  const uint count = groups[batch.group].pairs;
  for (uint i = gl_WorkGroupID.x; i < count; i += gl_NumWorkGroups.x) {
    const uint pair = pairs[first_pair + i];
    const PlacedCaster caster = placed(pair / VIEWS_A_BATCH);
    const SquareView square = square_view(batch.first_view + pair % VIEWS_A_BATCH, batch.atlas_size);
    for (uint first = 0u; first < caster.triangles; first += gl_WorkGroupSize.x) {
      const uint triangle = first + gl_LocalInvocationIndex;
      const bool exists = triangle < caster.triangles;
      const bool shown = exists && !is_empty(bounds_of(square, corners_of(square, caster, triangle)));
      list(shown, pair * SHADOW_CLUSTER + triangle);
    }
  }
}
