// From counts to places: an exclusive prefix sum over all clusters, by one work group that walks them in chunks.
// Based on: Hillis, Steele, Data Parallel Algorithms, CACM 29:12 (1986), for the sum within a chunk.
// Promise: ranges = (first, count); a cluster whose range ends beyond ENTRIES has NO_RANGE and is counted as overflowed.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "common/frame.glsl"
#include "lamplight/shared/counters.h"
#include "lamplight/shared/slices.h"

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint TILE_PX = 64;
layout(constant_id = 2) const uint SLICES = 24;
layout(constant_id = 3) const uint ENTRIES = 1;
layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) buffer RangeBuffer { uvec2 ranges[]; };
layout(set = 0, binding = 2, scalar) buffer CounterBuffer { Counters counters; };

shared uint s_sums[256];
shared uint s_total;

// Sums that would not fit stay at the largest number, which is past the end of any list.
uint add(uint a, uint b) { return a + b < a ? ~0u : a + b; }

void main() {
  const uint thread = gl_LocalInvocationIndex;
  const uint threads = gl_WorkGroupSize.x;
  const uint clusters = square_count(frame, TILE_PX) * SLICES;
  if (thread == 0u) s_total = 0u;
  for (uint first = 0u; first < clusters; first += threads) {
    const uint cluster = first + thread;
    const uint count = cluster < clusters ? ranges[cluster].y : 0u;
    s_sums[thread] = count;
    barrier();  // counts before the first addition
    for (uint step = 1u; step < threads; step *= 2u) {
      const uint left = thread >= step ? s_sums[thread - step] : 0u;
      barrier();  // all reads of a round before its writes
      s_sums[thread] = add(s_sums[thread], left);
      barrier();  // all writes of a round before the next
    }
    const uint begin = add(s_total, thread == 0u ? 0u : s_sums[thread - 1u]);
    if (cluster < clusters) {
      const bool fits = begin <= ENTRIES && count <= ENTRIES - begin;
      ranges[cluster] = uvec2(begin, fits ? count : NO_RANGE);
      if (!fits) atomicAdd(counters.overflowed_cells, 1u);
    }
    barrier();  // the old total is read before it grows
    if (thread == threads - 1u) s_total = add(s_total, s_sums[thread]);
    barrier();  // the new total and the sums before the next chunk
  }
  if (thread == 0u) counters.entries_needed = s_total;
}
