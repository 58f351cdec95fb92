// Radix sort of lights, third pass: one work group moves a block of lights to their places. Lights of equal
// digits keep their order, whichever thread comes first, so the result is the same every run.
// Needs: SORT_BY, as in sort_count_main.glsl.
// SPDX-License-Identifier: Apache-2.0
#include "common/sort_key.glsl"

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint SHIFT = 0;
layout(constant_id = 2) const bool FIRST = false;  // as in sort_count
layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) readonly buffer KeyBuffer { SORT_BY sort_by[]; };
layout(set = 0, binding = 2, scalar) readonly buffer OrderBuffer { uint order[]; };
layout(set = 0, binding = 3, scalar) readonly buffer CountBuffer { uint counts[]; };
layout(set = 0, binding = 4, scalar) readonly buffer TotalBuffer { uint totals[]; };
layout(set = 0, binding = 5, scalar) writeonly buffer SortedBuffer { uint sorted[]; };
#include "common/group_scan.glsl"

const uint WORDS = 8u;                    // 256 threads at most, one bit each
shared uint s_next[SORT_DIGITS];          // where the next light of a digit goes
shared uint s_has[SORT_DIGITS * WORDS];   // which threads hold a light of a digit

// Places of a digit begin behind all lights of smaller digits and those of the blocks before.
void make_places(uint blocks) {
  uint before = 0u;
  for (uint first = 0u; first < SORT_DIGITS; first += gl_WorkGroupSize.x) {
    const uint digit = first + gl_LocalInvocationIndex;
    uint total;
    const uint place = group_scan(totals[digit], total);
    s_next[digit] = before + place + counts[digit * blocks + gl_WorkGroupID.x];
    before += total;
  }
}

uint lights_of_digit(uint digit, uint words) {
  uint count = 0u;
  for (uint word = 0u; word < words; ++word) count += uint(bitCount(s_has[digit * WORDS + word]));
  return count;
}

void main() {
  const uint blocks = sort_blocks(frame);
  if (gl_WorkGroupID.x >= blocks) return;
  const uint thread = gl_LocalInvocationIndex;
  const uint bit = 1u << (thread % 32u);
  make_places(blocks);
  const uint begin = gl_WorkGroupID.x * SORT_BLOCK;
  const uint end = min(begin + SORT_BLOCK, light_count_of(frame));
  for (uint first = begin; first < end; first += gl_WorkGroupSize.x) {
    for (uint i = thread; i < SORT_DIGITS * WORDS; i += gl_WorkGroupSize.x) s_has[i] = 0u;
    barrier();  // cleared before bits are set; in the first round also: places before they are read
    const bool valid = first + thread < end;
    const uint light = !valid ? 0u : FIRST ? first + thread : order[first + thread];
    const uint digit = valid ? sort_digit(sort_by[light], SHIFT) : 0u;
    if (valid) atomicOr(s_has[digit * WORDS + thread / 32u], bit);
    barrier();  // all bits before lights count those before them
    if (valid) {
      const uint equal = lights_of_digit(digit, thread / 32u) + bitCount(s_has[digit * WORDS + thread / 32u] & (bit - 1u));
      sorted[s_next[digit] + equal] = light;
    }
    barrier();  // all places taken before they move on
    for (uint i = thread; i < SORT_DIGITS; i += gl_WorkGroupSize.x) s_next[i] += lights_of_digit(i, WORDS);
    barrier();  // moved on, and bits read, before the next round
  }
}
