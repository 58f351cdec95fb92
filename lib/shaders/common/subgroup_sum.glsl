// A prefix sum over the threads of a full subgroup. Some compilers cannot see that all threads are here, and make of
// subgroupInclusiveAdd a walk over those that are, twice as long as this.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_SUBGROUP_SUM
#define LAMP_COMMON_SUBGROUP_SUM
#extension GL_KHR_shader_subgroup_shuffle_relative : require

// The sum of the threads before and of this one; of two numbers likewise.
uint inclusive_sum(uint value) {
  for (uint step = 1u; step < gl_SubgroupSize; step *= 2u) {
    const uint before = subgroupShuffleUp(value, step);
    if (gl_SubgroupInvocationID >= step) value += before;
  }
  return value;
}

uvec2 inclusive_sum(uvec2 value) { return uvec2(inclusive_sum(value.x), inclusive_sum(value.y)); }

#endif
