// Counts each cluster's lights: ranges = (unused, count).
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lamplight/shared/frame.h"
#include "lamplight/shared/light.h"

layout(local_size_x_id = 0) in;
layout(constant_id = 1) const uint TILE_PX = 64;
#define SLICE_CONSTANT 2
#include "common/slice_constants.glsl"
layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) readonly buffer BoundsBuffer { LightBounds bounds[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer RangeBuffer { uvec2 ranges[]; };

uint found = 0u;
#define RADIAL_BINDING 3
#define VISIT(light) ++found
#define END_OF_WORD(word)
#define SURVIVORS(word, bits)
#include "methods/cluster_cull.glsl"

void main() {
  visit_clusters(gl_WorkGroupID.xy);
  const uint slice = gl_LocalInvocationIndex;
  if (slice < SLICES) ranges[cluster_index(gl_WorkGroupID.xy, slice)] = uvec2(0u, found);
}
