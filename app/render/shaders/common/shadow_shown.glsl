// Whether a view of a shadow map shows a caster.
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

bool shows_sphere(ShadowView view, vec4 sphere) {
  const vec3 rel = sphere.xyz - view.position;
  if (length(rel) - sphere.w > view.range_m) return false;
  for (uint i = 0u; i < 4u; ++i)
    if (dot(view.planes[i], rel) < -sphere.w) return false;
  return true;
}

// In the world: centre and radius.
vec4 caster_sphere(uint caster) {
  const mat4 m = instances[casters[caster].instance].world_from_object;
  const vec3 center = (m * vec4(casters[caster].center, 1.0)).xyz;
  // No vector grows by more than this (Frobenius).
  const float growth = sqrt(dot(m[0].xyz, m[0].xyz) + dot(m[1].xyz, m[1].xyz) + dot(m[2].xyz, m[2].xyz));
  const float longest = max(length(m[0].xyz), max(length(m[1].xyz), length(m[2].xyz)));
  const bool right_angled = abs(dot(m[0].xyz, m[1].xyz)) + abs(dot(m[1].xyz, m[2].xyz)) +
                            abs(dot(m[2].xyz, m[0].xyz)) < 1e-5 * longest * longest;
  return vec4(center, casters[caster].radius * (right_angled ? longest : growth) * ROOM);
}

#endif
