// Each pair of light and cell to its place among the cell's entries.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "common/frame.glsl"
#include "lamplight/shared/lamplight.h"

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint CELL_PX = 64;
layout(constant_id = 2) const uint LAYERS = 1;   // of cells
layout(constant_id = 3) const uint BLOCK = 256;  // lights
layout(constant_id = 4) const uint HITS = 1;     // capacity

layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) readonly buffer HitBuffer { LightHit hits[]; };
layout(set = 0, binding = 2, scalar) readonly buffer PlaceBuffer { uint places[]; };  // [block][cell]
layout(set = 0, binding = 3, scalar) readonly buffer TotalBuffer { LightTotals totals; };
layout(set = 0, binding = 4, scalar) writeonly buffer EntryBuffer { uint entries[]; };

void main() {
  if (gl_GlobalInvocationID.x >= min(totals.hits, HITS)) return;
  const LightHit hit = hits[gl_GlobalInvocationID.x];
  const uint cell = hit.place & (1u << HIT_CELL_BITS) - 1u;
  const uint begin = places[hit.light / BLOCK * (square_count(frame, CELL_PX) * LAYERS) + cell];
  if (begin != NO_PLACE) entries[begin + (hit.place >> HIT_CELL_BITS)] = hit.light;
}
