// Sets a light's bit, one atomic for all fragments of a subgroup that set bits of one word.
// Based on: Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017), "Atomic Contention", and
// the merging of bits among its improvements.
// Promise: right whoever is elected. Helper threads may be, and their atomics do nothing; so a thread looks whether its bit
// is there, and else sets it alone.
// Needs: `bits`, coherent.
// SPDX-License-Identifier: Apache-2.0
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_arithmetic : require

// Each turn serves the threads with the first thread's word, so every thread has one turn.
void set_bit(uint word, uint bit) {
  if ((bits[word] & bit) != 0u) return;
  for (bool waiting = true; waiting;) {
    if (subgroupBroadcastFirst(word) != word) continue;
    const uint merged = subgroupOr(bit);
    if (subgroupElect()) atomicOr(bits[word], merged);
    waiting = false;
  }
  memoryBarrierBuffer();  // the merged atomic before the look at what it did
  if ((bits[word] & bit) == 0u) atomicOr(bits[word], bit);
}
