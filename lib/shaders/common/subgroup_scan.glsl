// An exclusive prefix sum over the threads of a work group of full subgroups, with one barrier: each subgroup adds up
// what the subgroups before it hold. Between two scans a barrier must stand, as its shared memory is used again.
// Needs: GROUP_THREADS, a constant.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_SUBGROUP_SCAN
#define LAMP_COMMON_SUBGROUP_SCAN
#extension GL_KHR_shader_subgroup_arithmetic : require

shared uint s_subgroup_sums[GROUP_THREADS];  // there are no more subgroups than threads

// The thread's place in the order of the sum.
uint scan_thread() { return gl_SubgroupID * gl_SubgroupSize + gl_SubgroupInvocationID; }

// By all threads of the group together: the sum of the threads before.
uint subgroup_scan(uint value) {
  const uint end = subgroupInclusiveAdd(value);
  if (gl_SubgroupInvocationID == gl_SubgroupSize - 1u) s_subgroup_sums[gl_SubgroupID] = end;
  barrier();  // every subgroup's sum before they are added up
  uint before = end - value;
  for (uint i = 0u; i < gl_SubgroupID; ++i) before += s_subgroup_sums[i];
  return before;
}

#endif
