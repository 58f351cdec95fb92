// Writes each light into the buckets of its bricks, where the count's ranks say; and how many groups the pieces take that
// were counted. Where there was no room for all that was found, bricks are tested again, and lights take places as they come.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lamplight/shared/world.h"
#include "methods/world_find.glsl"

layout(constant_id = 6) const uint ROOM = 1;     // of a group, in what was found
layout(constant_id = 7) const uint ENTRIES = 1;  // capacity
layout(constant_id = 8) const uint WINDOW = 1;   // entries
layout(set = 0, binding = 3, scalar) buffer CountBuffer { uint counts[]; };  // places left, of bricks tested again
layout(set = 0, binding = 4, scalar) readonly buffer BucketBuffer { WorldBucket buckets[]; };
layout(set = 0, binding = 5, scalar) writeonly buffer EntryBuffer { uint entries[]; };
layout(set = 0, binding = 6, scalar) buffer TotalBuffer { WorldTotals totals; };
layout(set = 0, binding = 7, scalar) readonly buffer FoundBuffer { WorldFound found[]; };

uint entry_of(uint light, uint code) { return first_light_of_group() + light << ENTRY_CODE_BITS | code; }

void saw_level(uint level) {}

// A brick that is tested again.
void found_brick(uint light, uint code, uint bucket) {
  const WorldBucket own = buckets[bucket];
  if (own.count != WORLD_ALL) entries[own.first + atomicAdd(counts[bucket], ~0u) - 1u] = entry_of(light, code);
}

void place_by_rank(WorldFound one) {
  const WorldBucket own = buckets[one.bucket_light >> FOUND_LIGHT_BITS];
  if (own.count == WORLD_ALL) return;
  const uint light = one.bucket_light & (1u << FOUND_LIGHT_BITS) - 1u;
  entries[own.first + (one.rank_code >> ENTRY_CODE_BITS)] = entry_of(light, code_of_entry(one.rank_code));
}

void place_all_by_rank() {
  const uint first = gl_WorkGroupID.x * ROOM;
  const uint count = found[first].bucket_light;
  for (uint i = 1u + gl_LocalInvocationIndex; i <= count; i += gl_WorkGroupSize.x) place_by_rank(found[first + i]);
}

uvec3 groups_of(uint pieces) {
  return uvec3(min(pieces, WORLD_GROUPS_ACROSS), (pieces + WORLD_GROUPS_ACROSS - 1u) / WORLD_GROUPS_ACROSS, 1u);
}

void main() {
  if (totals.is_unkept == 0u)
    place_all_by_rank();
  else
    find_bricks();
  if (gl_GlobalInvocationID.x != 0u) return;
  const uvec3 pieces = groups_of(totals.pieces);
  totals.pieces_x = pieces.x;
  totals.pieces_y = pieces.y;
  totals.pieces_z = pieces.z;
  const uint held = min(totals.counters.entries_needed, ENTRIES);
  const uvec3 order = groups_of(totals.pieces + (held + WINDOW - 1u) / WINDOW);
  totals.order_x = order.x;
  totals.order_y = order.y;
  totals.order_z = order.z;
}
