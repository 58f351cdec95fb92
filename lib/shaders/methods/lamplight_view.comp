// Every light once: whether its bounding sphere meets the picture. Those that do are listed, in any order.
// Promise: the only pass that reads every light, 16 bytes of it.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_ballot : require

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint GROUP_FEW = 32;  // lights
#include "common/light_bounds.glsl"
#include "common/tile_volume.glsl"
#include "lamplight/shared/lamplight.h"
#include "methods/lamplight_share.glsl"

layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) readonly buffer SphereBuffer { LightSphere spheres[]; };
layout(set = 0, binding = 2, scalar) buffer TotalBuffer { LightTotals totals; };
layout(set = 0, binding = 3, scalar) writeonly buffer SeenBuffer { uint seen[]; };  // lights

shared uint s_seen_count;
shared uint s_begin;

// By one thread: room for the group's lights, and work groups of the next pass for them.
void reserve_seen() {
  const uint begin = s_seen_count == 0u ? 0u : atomicAdd(totals.seen, s_seen_count);
  if (s_seen_count > 0u) atomicMax(totals.find_x, groups_for(begin + s_seen_count));
  s_begin = begin;
}

void main() {
  const uint light = gl_GlobalInvocationID.x;
  if (gl_LocalInvocationIndex == 0u) s_seen_count = 0u;
  if (light == 0u) totals.find_y = totals.find_z = 1u;
  const RectangleEdges picture = rectangle_edges(frame, vec2(0.0), vec2(frame.size_px));
  LightBounds sphere = LightBounds(vec3(0.0), REACHES_NOTHING);
  if (light < light_count_of(frame)) sphere = view_bounds(frame, spheres[light]);
  const bool is_seen = sphere.radius >= 0.0 && inside_edges(sphere.center, sphere.radius, picture);
  const uvec4 those = subgroupBallot(is_seen);
  barrier();  // a count of zero before it is added to
  uint place = 0u;
  if (subgroupElect()) place = atomicAdd(s_seen_count, subgroupBallotBitCount(those));
  place = subgroupBroadcastFirst(place) + subgroupBallotExclusiveBitCount(those);
  barrier();  // every subgroup's count before room is reserved
  if (gl_LocalInvocationIndex == 0u) reserve_seen();
  barrier();  // room before it is filled
  if (is_seen) seen[s_begin + place] = light;
}
