// Which views of shadow maps show which casters: one thread for each pair. A caster's views become the instances of its
// indirect draw, so that one call draws all casters into all squares.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/shadow_shown.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint VIEWS_A_BATCH = 1;  // room for the views of a caster
layout(set = 0, binding = 3, scalar) buffer DrawBuffer { ShadowDraw draws[]; };
layout(set = 0, binding = 4, scalar) writeonly buffer PairBuffer { uint pairs[]; };
layout(push_constant, scalar) uniform Push { ShadowBatch batch; };

void main() {
  const uint caster = gl_GlobalInvocationID.x;
  const uint view = batch.first_view + gl_WorkGroupID.y;
  if (caster >= batch.casters || !shows_caster(view, caster)) return;
  const uint place = atomicAdd(draws[caster].instances, 1u);
  pairs[caster * VIEWS_A_BATCH + place] = view;
}
