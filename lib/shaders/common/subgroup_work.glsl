// Spreads the work items of a subgroup's threads over all of its threads, so that one with many keeps nobody waiting.
// For full subgroups whose threads are all here.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_SUBGROUP_WORK
#define LAMP_COMMON_SUBGROUP_WORK
#extension GL_KHR_shader_subgroup_shuffle : require
#include "common/subgroup_sum.glsl"

struct SharedWork {
  uint end;    // of this thread's items among all
  uint total;  // the same for every thread
};

SharedWork share_work(uint items) {
  const uint end = inclusive_sum(items);
  return SharedWork(end, subgroupShuffle(end, gl_SubgroupSize - 1u));
}

struct WorkItem {
  uint owner;   // thread of the subgroup that brought it
  uint number;  // among the owner's items
};

// Item i of all; some item or other when i >= total.
WorkItem work_item(SharedWork work, uint i) {
  uint owner = 0u;
  for (uint step = gl_SubgroupSize / 2u; step > 0u; step /= 2u)
    if (subgroupShuffle(work.end, owner + step - 1u) <= i) owner += step;
  const uint before = subgroupShuffle(work.end, max(owner, 1u) - 1u);
  return WorkItem(owner, i - (owner == 0u ? 0u : before));
}

#endif
