// Writes each light into the buckets of its bricks, in any order; and how many groups the pieces that were counted take.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lamplight/shared/world.h"

layout(constant_id = 4) const uint ENTRIES = 1;  // capacity
layout(set = 0, binding = 3, scalar) buffer CountBuffer { uint counts[]; };  // how many are written
layout(set = 0, binding = 4, scalar) readonly buffer BucketBuffer { WorldBucket buckets[]; };
layout(set = 0, binding = 5, scalar) writeonly buffer EntryBuffer { uint entries[]; };
layout(set = 0, binding = 6, scalar) buffer TotalBuffer { WorldTotals totals; };

void write_entry(uint light, uint code, uint bucket) {
  const WorldBucket own = buckets[bucket];
  if (own.count == WORLD_ALL) return;
  entries[own.first + atomicAdd(counts[bucket], 1u)] = light << ENTRY_BRICK_BITS | code;
}

#define SAW(level)
#define FOUND(light, code, bucket) write_entry(light, code, bucket)
#include "methods/world_find.glsl"

uvec3 groups_of(uint pieces) {
  return uvec3(min(pieces, WORLD_GROUPS_ACROSS), (pieces + WORLD_GROUPS_ACROSS - 1u) / WORLD_GROUPS_ACROSS, 1u);
}

void main() {
  find_bricks();
  if (gl_GlobalInvocationID.x != 0u) return;
  const uvec3 groups = groups_of(totals.pieces);
  totals.pieces_x = groups.x;
  totals.pieces_y = groups.y;
  totals.pieces_z = groups.z;
  const uvec3 long_groups = groups_of(totals.long_pieces);
  totals.long_x = long_groups.x;
  totals.long_y = long_groups.y;
  totals.long_z = long_groups.z;
  const uint held = min(totals.counters.entries_needed, ENTRIES);
  const uvec3 windows = groups_of((held + WORLD_WINDOW - 1u) / WORLD_WINDOW);
  totals.windows_x = windows.x;
  totals.windows_y = windows.y;
  totals.windows_z = windows.z;
}
