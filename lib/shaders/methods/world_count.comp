// Counts how many lights reach the bricks of each bucket, and marks the levels that lights are at. Keeps for the fill what
// each count was: a light's rank in the bucket.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "common/atomic_load.glsl"
#include "lamplight/shared/world.h"

layout(constant_id = 4) const uint KEPT = 1;  // ranks of a light that there is room for
layout(set = 0, binding = 3, scalar) buffer CountBuffer { uint counts[]; };
layout(set = 0, binding = 4, scalar) buffer LevelBuffer { uint levels; };  // bit l: a light is listed at level l
layout(set = 0, binding = 5, scalar) writeonly buffer RankBuffer { uint ranks[]; };  // KEPT for each light
layout(set = 0, binding = 6, scalar) buffer TotalBuffer { WorldTotals totals; };

// Most are marked already, and an atomic is dear.
void saw(uint level) {
  if ((LOAD_OF_DEVICE(levels) & 1u << level) == 0u) atomicOr(levels, 1u << level);
}

void keep(uint light, uint i, uint rank) {
  if (i < KEPT)
    ranks[light * KEPT + i] = rank;
  else if (LOAD_OF_DEVICE(totals.is_unkept) == 0u)
    atomicOr(totals.is_unkept, 1u);
}

#define SAW(level) saw(level)
#define FOUND(light, i, code, bucket) keep(light, i, atomicAdd(counts[bucket], 1u))
#define MISSED(light, i) keep(light, i, WORLD_NO_RANK)
#include "methods/world_find.glsl"

void main() {
  if (light_of_thread() < light_count_of(frame)) find_bricks(light_of_thread(), first_of_thread());
}
