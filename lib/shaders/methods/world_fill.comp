// Writes each light into the buckets of its bricks, where the count's ranks say; and how many groups the pieces take that
// were counted. Where there was no room for all ranks, bricks are tested again, and their lights take places as they come.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
#include "lamplight/shared/world.h"

layout(constant_id = 4) const uint ENTRIES = 1;  // capacity
layout(constant_id = 5) const uint KEPT = 1;     // ranks of a light
layout(constant_id = 6) const uint WINDOW = 1;   // entries
layout(set = 0, binding = 3, scalar) buffer CountBuffer { uint counts[]; };  // places left, of bricks tested again
layout(set = 0, binding = 4, scalar) readonly buffer BucketBuffer { WorldBucket buckets[]; };
layout(set = 0, binding = 5, scalar) writeonly buffer EntryBuffer { uint entries[]; };
layout(set = 0, binding = 6, scalar) buffer TotalBuffer { WorldTotals totals; };

layout(set = 0, binding = 7, scalar) readonly buffer RankBuffer { uint ranks[]; };

uint entry_of(uint light, uint code) { return light << ENTRY_CODE_BITS | code; }

void take_place(uint light, uint code, uint bucket) {
  const WorldBucket own = buckets[bucket];
  if (own.count != WORLD_ALL) entries[own.first + atomicAdd(counts[bucket], ~0u) - 1u] = entry_of(light, code);
}

#define SAW(level)
#define FOUND(light, i, code, bucket) take_place(light, code, bucket)
#define MISSED(light, i)
#include "methods/world_find.glsl"

const uint AT_ONCE = 2u;  // bricks of a thread, whose reads wait together

void place_by_rank(uint light, uint first) {
  const LightBricks b = bricks_of(frame, spheres[light]);
  const uint bricks = bricks_in(b);
  for (uint i = first; i < bricks; i += AT_ONCE * LIGHT_THREADS) {
    uint rank[AT_ONCE];
    [[unroll]] for (uint k = 0u; k < AT_ONCE; ++k) {
      const uint other = i + k * LIGHT_THREADS;
      rank[k] = WORLD_NO_RANK;
      if (other < bricks) rank[k] = ranks[light * KEPT + other];
    }
    uint entry[AT_ONCE];
    WorldBucket own[AT_ONCE];
    [[unroll]] for (uint k = 0u; k < AT_ONCE; ++k) {
      const vec3 brick = b.first + vec3(brick_offset(i + k * LIGHT_THREADS, b.size));
      entry[k] = entry_of(light, brick_code(brick));
      own[k].count = WORLD_ALL;
      if (rank[k] != WORLD_NO_RANK) own[k] = buckets[bucket_of(b.level, brick, BUCKETS)];
    }
    [[unroll]] for (uint k = 0u; k < AT_ONCE; ++k)
      if (own[k].count != WORLD_ALL) entries[own[k].first + rank[k]] = entry[k];
  }
}

uvec3 groups_of(uint pieces) {
  return uvec3(min(pieces, WORLD_GROUPS_ACROSS), (pieces + WORLD_GROUPS_ACROSS - 1u) / WORLD_GROUPS_ACROSS, 1u);
}

void place_light(uint light, uint first) {
  if (light >= light_count_of(frame)) return;
  if (totals.is_unkept == 0u)
    place_by_rank(light, first);
  else
    find_bricks(light, first);
}

void main() {
  place_light(light_of_thread(), first_of_thread());
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
