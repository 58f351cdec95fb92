// Adds up, for each pixel, how many samples of it were covered.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_EXT_scalar_block_layout : require

layout(constant_id = 0) const uint WIDTH = 1;
layout(set = 0, binding = 0, scalar) buffer SampleBuffer { uint covered[]; };

void main() {
  const uvec2 pixel = uvec2(gl_FragCoord.xy);
  atomicAdd(covered[pixel.x + WIDTH * pixel.y], uint(bitCount(gl_SampleMaskIn[0])));
}
