// What all passes that blur moments have in common: the separable Gaussian of nine taps, three texels apart, over the
// squares that were drawn, each by itself.
// Promise: no texel of another square is read: taps end at the edge of a square, or fold across that of an octahedron.
// Needs: BLUR_FORMAT, BLUR_VECTOR (vec2 or vec4, moments of a texel).
// SPDX-License-Identifier: Apache-2.0
#extension GL_EXT_control_flow_attributes : require
#include "shadow/parts/blur_step.glsl"
#include "shadow/parts/moments.glsl"

const int THREADS = 256;
layout(local_size_x = THREADS) in;

// A part of a square, for a work group: those of a square are counted line by line (app/render/shadow_moments.cpp).
struct BlurBlock {
  uint light;
  uint square;
  uint block;
};
layout(set = 0, binding = 3, scalar) readonly buffer BlockBuffer { BlurBlock blocks[]; };
layout(set = 0, binding = 4, BLUR_FORMAT) uniform writeonly image2D blurred;
layout(push_constant) uniform Push { uint block_count; };

const int TAPS = 9;
const int MOST_REACH = 12;  // texels, to the farthest tap

uint group_number() { return gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x; }

void blur_store(BlurBlock block, ivec2 texel, BLUR_VECTOR moments) {
  vec4 stored = vec4(0.0);
  [[unroll]] for (int i = 0; i < moments.length(); ++i) stored[i] = moments[i];
  imageStore(blurred, shadow_texel(block.light, block.square, texel), stored);
}
