// Which views of shadow maps show a caster.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_SHADOW_SHOWN
#define LAMP_SHADOW_SHOWN
#extension GL_EXT_scalar_block_layout : require
#include "scene_data.h"
#include "shadow_data.h"

layout(set = 0, binding = 0, scalar) readonly buffer ViewBuffer { ShadowView views[]; };
layout(set = 0, binding = 1, scalar) readonly buffer CasterBuffer { ShadowCaster casters[]; };
layout(set = 0, binding = 2, scalar) readonly buffer InstanceBuffer { InstanceData instances[]; };

// Of a sphere's radius, for the rounding of its place.
const float ROOM = 1.0001;

bool shows_sphere(ShadowView view, vec3 center, float radius) {
  const vec3 rel = center - view.position;
  if (length(rel) - radius > view.range_m) return false;
  for (uint i = 0u; i < 4u; ++i)
    if (dot(view.planes[i], rel) < -radius) return false;
  return true;
}

bool shows_caster(uint view, uint caster) {
  const mat4 m = instances[casters[caster].instance].world_from_object;
  const vec3 center = (m * vec4(casters[caster].center, 1.0)).xyz;
  // No vector grows by more than this (Frobenius).
  const float growth = sqrt(dot(m[0].xyz, m[0].xyz) + dot(m[1].xyz, m[1].xyz) + dot(m[2].xyz, m[2].xyz));
  const float longest = max(length(m[0].xyz), max(length(m[1].xyz), length(m[2].xyz)));
  const bool right_angled = abs(dot(m[0].xyz, m[1].xyz)) + abs(dot(m[1].xyz, m[2].xyz)) +
                            abs(dot(m[2].xyz, m[0].xyz)) < 1e-5 * longest * longest;
  return shows_sphere(views[view], center, casters[caster].radius * (right_angled ? longest : growth) * ROOM);
}

#endif
