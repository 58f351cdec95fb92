// What a work group of the blur is given, and where its result goes.
// Needs: BLUR_FORMAT, BLUR_VECTOR (vec2 or vec4, moments of a texel).
// SPDX-License-Identifier: Apache-2.0
#extension GL_EXT_control_flow_attributes : require
#include "shadow/parts/blur_step.glsl"
#include "shadow/parts/moments.glsl"

// A part of a square, for a work group: those of a square are counted line by line (app/render/shadow_moments.cpp).
struct BlurRecord {
  uint light;
  uint square;
  uint block;
};
layout(set = 0, binding = 3, scalar) readonly buffer BlockBuffer { BlurRecord blocks[]; };
layout(set = 0, binding = 4, BLUR_FORMAT) uniform writeonly image2D blurred;
layout(push_constant) uniform Push { uint block_count; };

const int TAPS = 9;
const int MOST_REACH = 12;  // texels, to the farthest tap

struct BlurBlock {
  ShadowSquare square;
  ShadowDepths depths;
  int number;  // of the square's
};

// `texel`: of the square, within it.
void blur_store(BlurBlock block, ivec2 texel, BLUR_VECTOR moments) {
  vec4 stored = vec4(0.0);
  [[unroll]] for (int i = 0; i < moments.length(); ++i) stored[i] = moments[i];
  imageStore(blurred, block.square.corner + texel, stored);
}

void blur_block(BlurBlock block);

void main() {
  const uint number = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  if (number >= block_count) return;
  const BlurRecord record = blocks[number];
  blur_block(BlurBlock(shadow_square(record.light, record.square), shadow_depths(record.light), int(record.block)));
}
