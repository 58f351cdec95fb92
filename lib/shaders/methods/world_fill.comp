// Writes each light into the buckets of its bricks, in any order.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lamplight/shared/world.h"

layout(set = 0, binding = 3, scalar) buffer CountBuffer { uint counts[]; };  // how many are written
layout(set = 0, binding = 4, scalar) readonly buffer BucketBuffer { WorldBucket buckets[]; };
layout(set = 0, binding = 5, scalar) writeonly buffer EntryBuffer { uint entries[]; };

void write_entry(uint light, uint code, uint bucket) {
  const WorldBucket own = buckets[bucket];
  if (own.count == WORLD_ALL) return;
  entries[own.first + atomicAdd(counts[bucket], 1u)] = light << ENTRY_BRICK_BITS | code;
}

#define SAW(level)
#define FOUND(light, code, bucket) write_entry(light, code, bucket)
#include "methods/world_find.glsl"
