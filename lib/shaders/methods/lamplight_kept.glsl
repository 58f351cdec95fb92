// Where a work group has a part of a cell's rows, many of the cell's lights miss all of them. These are left out before
// any pair of light and row is looked at.
// Needs: LIGHTS_MISS: whether that is done; s_edges, s_depths.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_KEPT
#define LAMP_METHODS_LAMPLIGHT_KEPT
#extension GL_KHR_shader_subgroup_ballot : require
#include "methods/lamplight_rows.glsl"

shared uint s_kept[PIECE];  // entries of the lights that may reach a row, in any order
shared uint s_kept_count;   // 0 beforehand

bool reaches_rows(LightBounds sphere) {
#ifdef SLICED
  if (!sphere_touches_depths(sphere, s_depths[0].z_near, s_depths[0].z_far)) return false;  // all are of one slice
#endif
  return inside_edges(sphere.center, sphere.radius, s_edges);
}

// By threads of a subgroup, all or some.
void keep_entry(uint entry, LightBounds sphere) {
  if (!LIGHTS_MISS) return;
  const bool is_kept = reaches_rows(sphere);
  const uvec4 those = subgroupBallot(is_kept);
  uint first = 0u;
  if (subgroupElect()) first = atomicAdd(s_kept_count, subgroupBallotBitCount(those));
  first = subgroupBroadcastFirst(first);
  if (is_kept) s_kept[first + subgroupBallotExclusiveBitCount(those)] = entry;
}

// Behind a barrier; `count`: entries of the piece.
uint kept_count(uint count) { return LIGHTS_MISS ? s_kept_count : count; }
uint kept_entry(uint i) { return LIGHTS_MISS ? s_kept[i] : i; }

#endif
