// Sorts keys in shared memory, ascending, by all threads of the group together.
// Based on: Batcher's bitonic sort in the form whose comparators all point the same way, so that any length works.
// Needs: SORT_KEYS, the shared array.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_SORT
#define LAMP_COMMON_SORT

void compare_exchange(uint first, uint count, uint low, uint high) {
  if (high >= count) return;  // beyond the keys stands an imaginary infinity
  const uint a = SORT_KEYS[first + low];
  const uint b = SORT_KEYS[first + high];
  if (a <= b) return;
  SORT_KEYS[first + low] = b;
  SORT_KEYS[first + high] = a;
}

void sort_keys(uint first, uint count) {
  const uint threads = gl_WorkGroupSize.x * gl_WorkGroupSize.y;
  for (uint run = 2u; run < 2u * count; run *= 2u) {
    for (uint step = run / 2u; step > 0u; step /= 2u) {
      for (uint i = gl_LocalInvocationIndex; 2u * i < count + run; i += threads) {
        const uint low = (i / step) * 2u * step + i % step;
        const uint high = step == run / 2u ? (low ^ (run - 1u)) : low + step;
        compare_exchange(first, count, low, high);
      }
      barrier();  // one step's exchanges before the next step reads
    }
  }
}

#endif
