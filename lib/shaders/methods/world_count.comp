// Counts how many lights reach the bricks of each bucket, and marks the levels that lights are at.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "common/atomic_load.glsl"
#include "lamplight/shared/world.h"

layout(set = 0, binding = 3, scalar) buffer CountBuffer { uint counts[]; };
layout(set = 0, binding = 4, scalar) buffer LevelBuffer { uint levels; };  // bit l: a light is listed at level l

// Most are marked already, and an atomic is dear.
void saw(uint level) {
  if ((LOAD_OF_DEVICE(levels) & 1u << level) == 0u) atomicOr(levels, 1u << level);
}

#define SAW(level) saw(level)
#define FOUND(light, code, bucket) atomicAdd(counts[bucket], 1u)
#include "methods/world_find.glsl"

void main() { find_bricks(); }
