// One thread a bin: the least and the greatest rank of the lights that reach into it, from the nodes above it.
// Based on: Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017): 16 + 16 bits a bin.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lamplight/shared/slices.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint BINS = 1;
layout(constant_id = 1) const uint LEAVES = 1;
layout(constant_id = 2) const bool WIDE = false;  // 32 + 32 bits
layout(set = 0, binding = 0, scalar) readonly buffer TreeBuffer { uvec2 tree[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer BinBuffer { uint bins[]; };

void main() {
  const uint bin = gl_GlobalInvocationID.x;
  if (bin >= BINS) return;
  uvec2 found = uvec2(0u);
  for (uint node = bin + LEAVES; node > 0u; node /= 2u) found = max(found, tree[node]);
  const bool empty = found.y == 0u;
  const uint least = ~found.x;
  const uint greatest = found.y - 1u;
  if (WIDE) {
    bins[2u * bin] = empty ? ~0u : least;
    bins[2u * bin + 1u] = empty ? 0u : greatest;
  } else {
    bins[bin] = empty ? EMPTY_BIN : least | greatest << 16;
  }
}
