// What a plan counts while it runs on the GPU; read back as Culler::counters.
// Promise: 16 bytes, zeroed at the start of every frame.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMPLIGHT_SHARED_COUNTERS_H
#define LAMPLIGHT_SHARED_COUNTERS_H

#include "glsl.h"

#ifdef __cplusplus
namespace lamp::shared {
#endif

struct Counters {
  uint overflowed_cells;  // cells whose list did not fit; their look-up walks every light instead
  uint entries_needed;    // list entries that all cells together need, where a plan has one shared list; else 0
  uint longest_list;      // of those that did not fit a list of their own
  uint excess_lights;     // lights beyond the capacity, of a count that only the GPU knew; filled where it is read back
};

#ifdef __cplusplus
static_assert(sizeof(Counters) == 16);
}  // namespace lamp::shared
#endif

#endif
