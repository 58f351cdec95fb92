// One thread a light in the order of depth: its rank goes to the nodes of a tree over the bins that together cover the
// light's bins, at most two a level, so that a light that reaches through all bins costs no more than others.
// Based on: Bentley's segment tree (1977), with maxima at the nodes; z-bins: Drobot, SIGGRAPH Advances (2017).
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "common/box_tests.glsl"
#include "common/frame.glsl"
#include "lamplight/shared/light.h"

layout(local_size_x = 64) in;
#define SLICE_CONSTANT 0  // bins
#include "common/slice_constants.glsl"
layout(constant_id = 4) const uint LEAVES = 1;  // bins, rounded up to a power of two
layout(constant_id = 5) const bool SHAPES = false;  // boxes by the depths of their shape
layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) readonly buffer SortedBuffer { LightBounds sorted[]; };
layout(set = 0, binding = 2, scalar) buffer TreeBuffer { uvec2 tree[]; };  // ~least and greatest + 1; 0: no light
layout(set = 0, binding = 3, scalar) readonly buffer OrderBuffer { uint order[]; };      // SHAPES alone
layout(set = 0, binding = 4, scalar) readonly buffer RecordBuffer { Light records[]; };  // SHAPES alone

// Metres ahead.
vec2 depths_of(uint rank) {
  const LightBounds sphere = sorted[rank];
  if (!SHAPES) return -sphere.center.z + vec2(-sphere.radius, sphere.radius);
  return depth_span(frame, order[rank], records[order[rank]], sphere);
}

void mark(uint node, uint rank) {
  atomicMax(tree[node].x, ~rank);
  atomicMax(tree[node].y, rank + 1u);
}

void main() {
  const uint rank = gl_GlobalInvocationID.x;
  if (rank >= light_count_of(frame) || sorted[rank].radius < 0.0) return;
  const vec2 depths = depths_of(rank);
  const uvec2 bins = slices_of(depths.x, depths.y);
  uint left = bins.x + LEAVES;
  uint right = bins.y + LEAVES + 1u;
  for (; left < right; left /= 2u, right /= 2u) {
    if ((left & 1u) != 0u) mark(left++, rank);
    if ((right & 1u) != 0u) mark(--right, rank);
  }
}
