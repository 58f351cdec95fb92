// Which views of shadow maps show which casters: a thread for each caster and set of views that are drawn together. A
// caster has an indirect draw in each set; the views that show it are its instances.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/shadow_shown.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 3, scalar) readonly buffer CasterDrawBuffer { ShadowDraw caster_draws[]; };
layout(set = 0, binding = 4, scalar) writeonly buffer PairBuffer { uint pairs[]; };
layout(set = 0, binding = 5, scalar) writeonly buffer DrawBuffer { ShadowDraw draws[]; };
layout(push_constant, scalar) uniform Push { ShadowBatch batch; };

void main() {
  const uint caster = gl_GlobalInvocationID.x;
  const uint set = gl_WorkGroupID.y;
  if (caster >= batch.casters) return;
  const uint count = min(VIEWS_A_DRAW, batch.views - set * VIEWS_A_DRAW);
  const vec4 sphere = caster_sphere(caster);
  uint shown = 0u;
  for (uint i = 0u; i < count; ++i)
    if (shows_sphere(views[batch.first_view + set * VIEWS_A_DRAW + i], sphere)) shown |= 1u << i;
  const uint place = set * batch.casters + caster;
  ShadowDraw draw = caster_draws[caster];
  draw.instances = bitCount(shown);
  draw.first_instance = place * VIEWS_A_DRAW;
  draws[place] = draw;
  for (uint i = draw.first_instance; shown != 0u; shown &= shown - 1u)
    pairs[i++] = caster * VIEWS_A_DRAW + uint(findLSB(shown));
}
