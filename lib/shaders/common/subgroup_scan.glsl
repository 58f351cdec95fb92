// An exclusive prefix sum over the threads of a work group of full subgroups, with one barrier: each subgroup adds up
// what the subgroups before it hold. Between two scans a barrier must stand, as its shared memory is used again.
// Needs: MOST_SUBGROUPS, a constant.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_SUBGROUP_SCAN
#define LAMP_COMMON_SUBGROUP_SCAN
#include "common/subgroup_sum.glsl"

shared uvec2 s_subgroup_sums[MOST_SUBGROUPS];

// The thread's place in the order of the sum.
uint scan_thread() { return gl_SubgroupID * gl_SubgroupSize + gl_SubgroupInvocationID; }

// By all threads of the group together: the sum of the threads before.
uint subgroup_scan(uint value) {
  const uint end = inclusive_sum(value);
  if (gl_SubgroupInvocationID == gl_SubgroupSize - 1u) s_subgroup_sums[gl_SubgroupID].x = end;
  barrier();  // every subgroup's sum before they are added up
  uint before = end - value;
  for (uint i = 0u; i < gl_NumSubgroups; ++i) before += i < gl_SubgroupID ? s_subgroup_sums[i].x : 0u;
  return before;
}

// Of two numbers at once, and the sum of all threads.
uvec2 subgroup_scan(uvec2 value, out uvec2 total) {
  const uvec2 end = inclusive_sum(value);
  if (gl_SubgroupInvocationID == gl_SubgroupSize - 1u) s_subgroup_sums[gl_SubgroupID] = end;
  barrier();  // every subgroup's sums before they are added up
  uvec2 before = end - value;
  total = uvec2(0u);
  for (uint i = 0u; i < gl_NumSubgroups; ++i) {
    if (i < gl_SubgroupID) before += s_subgroup_sums[i];
    total += s_subgroup_sums[i];
  }
  return before;
}

#endif
