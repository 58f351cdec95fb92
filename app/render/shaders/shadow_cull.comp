// Which views of shadow maps show which casters: one thread for each pair. A caster's views become the instances of its
// indirect draw, so that one call draws all casters into all squares.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "scene_data.h"
#include "shadow_data.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint VIEWS_A_BATCH = 1;  // room for the views of a caster
layout(set = 0, binding = 0, scalar) readonly buffer ViewBuffer { ShadowView views[]; };
layout(set = 0, binding = 1, scalar) readonly buffer CasterBuffer { ShadowCaster casters[]; };
layout(set = 0, binding = 2, scalar) readonly buffer InstanceBuffer { InstanceData instances[]; };
layout(set = 0, binding = 3, scalar) buffer DrawBuffer { ShadowDraw draws[]; };
layout(set = 0, binding = 4, scalar) writeonly buffer PairBuffer { uint pairs[]; };
layout(push_constant, scalar) uniform Push { ShadowBatch batch; };

// Of a sphere's radius, for the rounding of its place.
const float ROOM = 1.0001;

bool is_shown(ShadowView view, vec3 center, float radius) {
  const vec3 rel = center - view.position;
  if (length(rel) - radius > view.range_m) return false;
  for (uint i = 0u; i < 4u; ++i)
    if (dot(view.planes[i], rel) < -radius) return false;
  return true;
}

void main() {
  const uint caster = gl_GlobalInvocationID.x;
  if (caster >= batch.casters) return;
  const uint view = batch.first_view + gl_WorkGroupID.y;
  const mat4 m = instances[casters[caster].instance].world_from_object;
  const vec3 center = (m * vec4(casters[caster].center, 1.0)).xyz;
  // No vector grows by more than this (Frobenius).
  const float growth = sqrt(dot(m[0].xyz, m[0].xyz) + dot(m[1].xyz, m[1].xyz) + dot(m[2].xyz, m[2].xyz));
  const float longest = max(length(m[0].xyz), max(length(m[1].xyz), length(m[2].xyz)));
  const bool right_angled = abs(dot(m[0].xyz, m[1].xyz)) + abs(dot(m[1].xyz, m[2].xyz)) +
                            abs(dot(m[2].xyz, m[0].xyz)) < 1e-5 * longest * longest;
  const float radius = casters[caster].radius * (right_angled ? longest : growth) * ROOM;
  if (!is_shown(views[view], center, radius)) return;
  const uint place = atomicAdd(draws[caster].instances, 1u);
  pairs[caster * VIEWS_A_BATCH + place] = view;
}
