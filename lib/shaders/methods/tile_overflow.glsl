// Counts a tile's list that did not fit, by one thread of its group.
// Needs: `counters`, and tile_cull.glsl.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_TILE_OVERFLOW
#define LAMP_METHODS_TILE_OVERFLOW

void count_overflow(uint range) {
  atomicAdd(counters.overflowed_cells, 1u);
  atomicMax(counters.longest_list, s_light_count[range]);
}

#endif
