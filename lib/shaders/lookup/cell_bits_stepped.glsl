// Look-up: that of cell_bits, for devices that end a thread's loops.
// SPDX-License-Identifier: Apache-2.0
#include "lookup/cell_bits.glsl"
#undef LOOKUP_TOGETHER

LOOKUP_CONSTANT(9, uint, LOOKUP_STEPS, 1);

bool walk_left(Walk walk) { return walk.bits != 0u || walk.word < walk.words; }

bool walk_step(inout Walk walk, out uint light) {
  light = 0u;
  if (walk.bits == 0u && walk.word < walk.words) lookup_next_word(walk);
  if (walk.bits == 0u) return false;
  light = lookup_lowest(walk);
  return true;
}

#include "lookup/parts/steps.glsl"
