// Sets a light's bit, one atomic for all fragments of a subgroup that set bits of one word.
// Based on: Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017), "Atomic Contention", and
// the merging of bits among its improvements.
// Promise: right at any subgroup size, whichever of its threads arrive, and however many words they write to. Operations
// are of the threads in the same turn; these share a word, and as none is a helper, whose atomics do nothing, the elected
// one writes for all. A turn serves at least the first thread that waits, so turns end.
// Needs: `bits`.
// SPDX-License-Identifier: Apache-2.0
#include "common/atomic_load.glsl"
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_arithmetic : require

// A helper thread covers no sample. (gl_HelperInvocation says the same, but lavapipe of Mesa 22 cannot compile it.)
bool is_helper() { return gl_SampleMaskIn[0] == 0; }

// Each turn serves the threads with the first thread's word, so every thread has one turn. A look that is too early to see
// the bit costs an atomic, no more.
void set_bit(uint word, uint bit) {
  for (bool waiting = !is_helper() && (LOAD_OF_DEVICE(bits[word]) & bit) == 0u; waiting;) {
    if (subgroupBroadcastFirst(word) != word) continue;
    const uint merged = subgroupOr(bit);
    if (subgroupElect()) atomicOr(bits[word], merged);
    waiting = false;
  }
}
