// Counts how many lights reach the bricks of each bucket, and marks the levels that lights are at. Keeps for the fill what was
// found: which light is the how-manieth of which bucket.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "common/atomic_load.glsl"
#include "lamplight/shared/world.h"
#include "methods/world_find.glsl"

layout(constant_id = 6) const uint ROOM = 1;  // of a group: how many it found, and behind that these
layout(set = 0, binding = 3, scalar) buffer CountBuffer { uint counts[]; };
layout(set = 0, binding = 4, scalar) buffer LevelBuffer { uint levels; };  // bit l: a light is listed at level l
layout(set = 0, binding = 5, scalar) writeonly buffer FoundBuffer { WorldFound found[]; };  // ROOM for each group
layout(set = 0, binding = 6, scalar) buffer TotalBuffer { WorldTotals totals; };

shared uint s_found;

// Most are marked already, and an atomic is dear.
void saw_level(uint level) {
  if ((LOAD_OF_DEVICE(levels) & 1u << level) == 0u) atomicOr(levels, 1u << level);
}

void found_brick(uint light, uint code, uint bucket) {
  const uint rank = atomicAdd(counts[bucket], 1u);
  const uint place = 1u + atomicAdd(s_found, 1u);
  if (place >= ROOM) return;
  found[gl_WorkGroupID.x * ROOM + place] =
      WorldFound(bucket << FOUND_LIGHT_BITS | light, rank << ENTRY_CODE_BITS | code);
}

void main() {
  if (gl_LocalInvocationIndex == 0u) s_found = 0u;
  find_bricks();
  barrier();  // all are counted
  if (gl_LocalInvocationIndex != 0u) return;
  found[gl_WorkGroupID.x * ROOM] = WorldFound(s_found, 0u);
  if (s_found >= ROOM) atomicOr(totals.is_unkept, 1u);
}
