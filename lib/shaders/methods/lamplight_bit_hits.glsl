// Hits as bits, where lights are few: a line for each cell, a bit for every light, and a count. A bit needs no room, no
// rank and no place, so nothing is left to scan or to scatter.
// Needs: `frame`. Gives group_share, lights_to_find, light_to_find; clear_hits, keep_hit, keep_last_hits.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_BIT_HITS
#define LAMP_METHODS_LAMPLIGHT_BIT_HITS

layout(constant_id = 4) const uint SHARE = 32;  // lights of a work group

layout(set = 0, binding = 3, scalar) buffer BitBuffer { uint cell_bits[]; };  // [cell][word]
layout(set = 0, binding = 4, scalar) buffer CellBuffer { LightCell cells[]; };

uint group_share() { return SHARE; }
uint lights_to_find() { return light_count_of(frame); }
uint light_to_find(uint i) { return i; }

void clear_hits() {}

// Each thread with a hit of its own, or none.
void keep_hit(bool is_hit, uint light, uint cell, inout uint waiting) {
  if (!is_hit) return;
  const uint words = (light_count_of(frame) + 31u) / 32u;
  atomicOr(cell_bits[cell * words + light / 32u], 1u << (light % 32u));
  atomicAdd(cells[cell].entries, 1u);
}

void keep_last_hits(uint waiting) {}

#endif
