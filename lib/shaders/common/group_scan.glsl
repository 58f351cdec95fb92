// An exclusive prefix sum over the threads of a work group, 256 at most.
// Based on: Hillis, Steele, Data Parallel Algorithms, CACM 29:12 (1986).
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_GROUP_SCAN
#define LAMP_COMMON_GROUP_SCAN

shared uint s_scan[256];

// For all threads of the group together. Returns the sum of the threads before; `total` is that of all.
uint group_scan(uint value, out uint total) {
  const uint thread = gl_LocalInvocationIndex;
  barrier();  // the last scan is read before this one writes
  s_scan[thread] = value;
  barrier();  // values before the first addition
  for (uint step = 1u; step < gl_WorkGroupSize.x; step *= 2u) {
    const uint left = thread >= step ? s_scan[thread - step] : 0u;
    barrier();  // all reads of a round before its writes
    s_scan[thread] += left;
    barrier();  // all writes of a round before the next
  }
  total = s_scan[gl_WorkGroupSize.x - 1u];
  return s_scan[thread] - value;
}

#endif
