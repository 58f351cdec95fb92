// Writes each cluster's lights, ascending, at the place that the scan gave it; and for a tile with a cluster that does
// not fit, one bit a light that is between the tile's sides.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lamplight/shared/frame.h"
#include "lamplight/shared/light.h"
#include "lamplight/shared/slices.h"

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint TILE_PX = 64;
#define SLICE_CONSTANT 2
#include "common/slice_constants.glsl"
layout(constant_id = 7) const uint WORDS = 0;  // of a tile's bits; 0: there are none
layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) readonly buffer BoundsBuffer { LightBounds bounds[]; };
layout(set = 0, binding = 2, scalar) readonly buffer RangeBuffer { uvec2 ranges[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer ListBuffer { uint lists[]; };
layout(set = 0, binding = 4, scalar) writeonly buffer BitBuffer { uint tile_bits[]; };

shared bool s_overflowed;

uint at = 0u;
uint end = 0u;  // equal to `at` for a cluster that does not fit
#define RADIAL_BINDING 5
#define VISIT(light) if (at < end) lists[at++] = light
#define END_OF_WORD(word)
#define SURVIVORS(word, bits) keep(word, bits)

void keep(uint word, uint bits) {
  const uint tile = gl_WorkGroupID.x + gl_NumWorkGroups.x * gl_WorkGroupID.y;
  if (s_overflowed && word < WORDS) tile_bits[tile * WORDS + word] = bits;
}
#include "methods/cluster_cull.glsl"

void main() {
  const uint slice = gl_LocalInvocationIndex;
  if (slice == 0u) s_overflowed = false;
  barrier();  // cleared before it is set
  if (slice < SLICES) {
    const uvec2 range = ranges[cluster_index(gl_WorkGroupID.xy, slice)];
    at = range.x;
    const bool fits = range.y != NO_RANGE;
    end = fits ? range.x + range.y : range.x;
    if (!fits) s_overflowed = true;
  }
  barrier();  // set before survivors are kept
  visit_clusters(gl_WorkGroupID.xy);
}
