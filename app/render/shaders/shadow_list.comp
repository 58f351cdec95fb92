// Which views of shadow maps show which casters, as a list of pairs for each group of casters: what rasterization in
// compute goes through.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/shadow_shown.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint VIEWS_A_BATCH = 1;
layout(set = 0, binding = 3, scalar) buffer GroupBuffer { ShadowGroup groups[]; };
layout(set = 0, binding = 4, scalar) writeonly buffer PairBuffer { uint pairs[]; };
layout(push_constant, scalar) uniform Push { ShadowBatch batch; };

void main() {
  const uint caster = gl_GlobalInvocationID.x;
  const uint view = batch.first_view + gl_WorkGroupID.y;
  if (caster >= batch.casters || !shows_sphere(views[view], caster_sphere(caster))) return;
  const uint group = casters[caster].group;
  const uint place = atomicAdd(groups[group].pairs, 1u);
  pairs[groups[group].first_caster * VIEWS_A_BATCH + place] = caster * VIEWS_A_BATCH + gl_WorkGroupID.y;
}
