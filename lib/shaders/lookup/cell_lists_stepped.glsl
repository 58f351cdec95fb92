// Look-up: that of cell_lists, for devices that end a thread's loops.
// SPDX-License-Identifier: Apache-2.0
#include "lookup/cell_lists.glsl"
#undef LOOKUP_TOGETHER

LOOKUP_CONSTANT(9, uint, LOOKUP_STEPS, 1);

bool walk_left(Walk walk) { return walk.at < walk.end || walk.span < walk.spans; }

bool walk_step(inout Walk walk, out uint light) {
  light = 0u;
  if (walk.at >= walk.end && walk.span < walk.spans) lookup_next_span(walk);
  if (walk.at >= walk.end) return false;
  light = lookup_light_at(walk, walk.at);
  ++walk.at;
  return true;
}

#include "lookup/parts/steps.glsl"
