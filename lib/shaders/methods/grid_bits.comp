// One work group a block of lights, an axis and some slices of it: a bit for each light that reaches the slice, and a bit
// for each word of those. A word without a bit is not written: who finds no bit of it does not read it.
// Based on: Ikkala et al., Hierarchical Bitmask Implicit Grids, GRAPP (2024).
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
#include "common/frame.glsl"
#include "lamplight/shared/implicit_grid.h"

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint SLICES = 8;
layout(constant_id = 2) const uint LIGHTS = 1;  // capacity
layout(constant_id = 3) const uint BLOCKS = 1;  // of the capacity
layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) readonly buffer RangeBuffer { uint ranges[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer WordBuffer { uint block_words[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer BitBuffer { uint bits[]; };

const uint PITCH = 33u;  // of a word's ranges: threads that read theirs at once find them in different banks
shared uint s_ranges[GRID_BLOCK_WORDS * PITCH];
shared uint s_words[GRID_GROUP_SLICES];

uint first_of(uint range) { return range & (1u << GRID_LAST_SHIFT) - 1u; }
uint last_of(uint range) { return range >> GRID_LAST_SHIFT; }

// The first and the last slice that any light of the word reaches.
uvec2 slices_of_word(uint word) {
  uvec2 slices = uvec2(~0u, 0u);
  [[unroll]] for (uint i = 0u; i < 32u; ++i) {
    const uint range = s_ranges[word * PITCH + i];
    if (first_of(range) > last_of(range)) continue;
    slices = uvec2(min(slices.x, first_of(range)), max(slices.y, last_of(range)));
  }
  return slices;
}

uint bits_of_word(uint word, uint slice) {
  uint found = 0u;
  [[unroll]] for (uint i = 0u; i < 32u; ++i) {
    const uint range = s_ranges[word * PITCH + i];
    found |= uint(first_of(range) <= slice && slice <= last_of(range)) << i;
  }
  return found;
}

void main() {
  const uint thread = gl_LocalInvocationIndex;
  const uint block = gl_WorkGroupID.x;
  const uint axis = gl_WorkGroupID.y;
  const uint first_slice = gl_WorkGroupID.z * GRID_GROUP_SLICES;
  const uint first = block * GRID_BLOCK;
  for (uint i = thread; i < GRID_BLOCK; i += gl_WorkGroupSize.x)
    s_ranges[i / 32u * PITCH + i % 32u] =
        first + i < light_count_of(frame) ? ranges[axis * LIGHTS + first + i] : GRID_NO_SLICES;
  for (uint i = thread; i < GRID_GROUP_SLICES; i += gl_WorkGroupSize.x) s_words[i] = 0u;
  barrier();  // ranges and zeros before bits
  const uint end = min(first_slice + GRID_GROUP_SLICES, SLICES + 1u);
  const uint word = thread % GRID_BLOCK_WORDS;
  const uvec2 reached = slices_of_word(word);
  for (uint slice = first_slice + thread / GRID_BLOCK_WORDS; slice < end; slice += gl_WorkGroupSize.x / GRID_BLOCK_WORDS) {
    if (slice < reached.x || slice > reached.y) continue;
    const uint found = bits_of_word(word, slice);
    if (found == 0u) continue;
    bits[((axis * (SLICES + 1u) + slice) * BLOCKS + block) * GRID_BLOCK_WORDS + word] = found;
    atomicOr(s_words[slice - first_slice], 1u << word);
  }
  barrier();  // all bits before the words that name them
  for (uint slice = first_slice + thread; slice < end; slice += gl_WorkGroupSize.x)
    block_words[(axis * (SLICES + 1u) + slice) * BLOCKS + block] = s_words[slice - first_slice];
}
