// Hits as a list, where lights are many: pairs of light and cell are counted in a matrix, blocks of lights by cells,
// where each learns its rank, and are kept for scattering. They wait in the subgroup's part of shared memory until
// there are enough to write.
// Needs: cell_count. Gives group_share, lights_to_find, light_to_find; keep_hit, keep_last_hits.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_LIST_HITS
#define LAMP_METHODS_LAMPLIGHT_LIST_HITS
#extension GL_KHR_shader_subgroup_ballot : require

layout(constant_id = 4) const uint GROUP_FEW = 32;   // lights
layout(constant_id = 10) const uint BLOCK = 256;     // lights
layout(constant_id = 11) const uint HITS = 1;        // capacity
layout(constant_id = 12) const uint GROUP_HITS = 1;  // that wait in shared memory

layout(set = 0, binding = 3, scalar) buffer CountBuffer { uint counts[]; };  // [block][cell]
layout(set = 0, binding = 4, scalar) buffer TotalBuffer { LightTotals totals; };
layout(set = 0, binding = 5, scalar) writeonly buffer HitBuffer { LightHit hits[]; };
layout(set = 0, binding = 6, scalar) readonly buffer SeenBuffer { uint seen[]; };  // lights in view
#include "methods/lamplight_share.glsl"

shared LightHit s_hits[GROUP_HITS];  // a subgroup uses its own part
shared uint s_group_hits;
shared uint s_begin;

uint group_share() { return lights_of_group(totals.seen); }
uint lights_to_find() { return totals.seen; }
uint light_to_find(uint i) { return seen[i]; }

void clear_hits() { s_group_hits = 0u; }

// Room among all hits, by one thread.
uint reserve_hits(uint count) {
  const uint begin = atomicAdd(totals.hits, count);
  if (begin > ENOUGH) atomicMin(totals.hits, ENOUGH);
  return begin;
}

// All below is for the threads of a subgroup together. `waiting`: its hits since they were last written.
uint hits_room() { return GROUP_HITS / gl_NumSubgroups; }
uint first_hit() { return gl_SubgroupID * hits_room(); }

// To the room that begins there.
void write_hits(uint begin, uint count) {
  subgroupMemoryBarrierShared();
  subgroupBarrier();  // hits are there before they are read
  for (uint i = gl_SubgroupInvocationID; i < count; i += gl_SubgroupSize) {
    const LightHit hit = s_hits[first_hit() + i];
    const uint rank = atomicAdd(counts[hit.light / BLOCK * cell_count() + hit.place], 1u);
    if (begin + i < HITS) hits[begin + i] = LightHit(hit.light, hit.place | rank << HIT_CELL_BITS);
  }
  subgroupBarrier();  // and read before others take their place
}

void flush_hits(inout uint waiting) {
  uint begin = 0u;
  if (subgroupElect()) begin = reserve_hits(waiting);
  write_hits(subgroupBroadcastFirst(begin), waiting);
  waiting = 0u;
}

// Each thread with a hit of its own, or none.
void keep_hit(bool is_hit, uint light, uint cell, inout uint waiting) {
  const uvec4 those = subgroupBallot(is_hit);
  const uint count = subgroupBallotBitCount(those);
  if (waiting + count > hits_room()) flush_hits(waiting);
  if (is_hit) s_hits[first_hit() + waiting + subgroupBallotExclusiveBitCount(those)] = LightHit(light, cell);
  waiting += count;
}

// By all subgroups: what still waits takes its room together, because the total is one number for the whole GPU.
void keep_last_hits(uint waiting) {
  uint place = 0u;
  if (subgroupElect()) place = atomicAdd(s_group_hits, waiting);
  barrier();  // every subgroup's hits before room is reserved
  if (gl_LocalInvocationIndex == 0u && s_group_hits > 0u) s_begin = reserve_hits(s_group_hits);
  barrier();  // room before it is filled
  if (waiting > 0u) write_hits(s_begin + subgroupBroadcastFirst(place), waiting);
}

#endif
