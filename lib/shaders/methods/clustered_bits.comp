// Writes each cluster's lights as a flat bit array; bit N is light N.
// Based on: Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017).
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
layout(constant_id = 7) const uint WORDS = 1;  // words a cluster: light capacity / 32, rounded up
layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) readonly buffer BoundsBuffer { LightBounds bounds[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer BitBuffer { uint bits[]; };

uint base = 0u;
uint found = 0u;
void write_word(uint word) {
  if (word < WORDS) bits[base + word] = found;
  found = 0u;
}
#define RADIAL_BINDING 3
#define VISIT(light) found |= 1u << ((light) % 32u)
#define END_OF_WORD(word) write_word(word)
#define SURVIVORS(word, bits)
#include "methods/cluster_cull.glsl"

void main() {
  base = cluster_index(gl_WorkGroupID.xy, min(gl_LocalInvocationIndex, SLICES - 1u)) * WORDS;
  visit_clusters(gl_WorkGroupID.xy);
}
