// Radix sort of lights, first of three passes a digit: one work group counts the digits of a block of lights.
// Based on: Satish, Harris, Garland, Designing Efficient Sorting Algorithms for Manycore GPUs, IPDPS (2009).
// Needs: SORT_BY, what a light's key is made of: LightBounds (its depth) or uint (the key).
// SPDX-License-Identifier: Apache-2.0
#include "common/sort_key.glsl"

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint SHIFT = 0;
layout(constant_id = 2) const bool FIRST = false;  // the order so far is the lights' own; `order` is not read
layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) readonly buffer KeyBuffer { SORT_BY sort_by[]; };
layout(set = 0, binding = 2, scalar) readonly buffer OrderBuffer { uint order[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer CountBuffer { uint counts[]; };  // digit by digit, block by block

shared uint s_counts[SORT_DIGITS];

void main() {
  const uint blocks = sort_blocks(frame);
  if (gl_WorkGroupID.x >= blocks) return;
  const uint thread = gl_LocalInvocationIndex;
  for (uint digit = thread; digit < SORT_DIGITS; digit += gl_WorkGroupSize.x) s_counts[digit] = 0u;
  barrier();  // cleared before counting
  const uint first = gl_WorkGroupID.x * SORT_BLOCK;
  for (uint i = first + thread; i < min(first + SORT_BLOCK, light_count_of(frame)); i += gl_WorkGroupSize.x)
    atomicAdd(s_counts[sort_digit(sort_by[FIRST ? i : order[i]], SHIFT)], 1u);
  barrier();  // all counted before they are written
  for (uint digit = thread; digit < SORT_DIGITS; digit += gl_WorkGroupSize.x)
    counts[digit * blocks + gl_WorkGroupID.x] = s_counts[digit];
}
