// A pass of the separable Gaussian of nine taps over the squares that were drawn, each by itself: a work group takes a
// block of a square, 16 lines of up to 64 texels, with what their taps reach beside them in shared memory.
// Promise: no texel of another square is read: taps end at the edge of a square, or fold across that of an octahedron.
// Needs: BLUR_ALONG_X (bool), vec4 blur_source(uint light, ivec2 texel of the atlas), BLUR_FORMAT.
// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/blur_step.glsl"
#include "shadow/parts/moments.glsl"

layout(local_size_x = 256) in;

// Of those of a square, which are counted line by line of the pass's direction (app/render/shadow_moments.cpp).
struct BlurBlock {
  uint light;
  uint square;
  uint block;
};
layout(set = 0, binding = 3, scalar) readonly buffer BlockBuffer { BlurBlock blocks[]; };
layout(set = 0, binding = 4, BLUR_FORMAT) uniform writeonly image2D blurred;
layout(push_constant) uniform Push { uint block_count; };

const int LINES = int(LEAST_SQUARE);  // of a block; 16 threads each, in either direction
const int MOST_WIDTH = 64;
const int REACH = 12;  // texels, of the farthest tap
const int MOST_WIDE = MOST_WIDTH + 2 * REACH;
shared vec4 s_texels[LINES * MOST_WIDE];

ivec2 texel_at(int along, int across) { return BLUR_ALONG_X ? ivec2(along, across) : ivec2(across, along); }

// Neighbours of the atlas lie side by side.
int place_of(int along, int across) { return BLUR_ALONG_X ? across * MOST_WIDE + along : along * LINES + across; }

void main() {
  const uint number = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  if (number >= block_count) return;
  const BlurBlock block = blocks[number];
  const int side = int(shadow_maps[block.light].side);
  const int width = min(side, MOST_WIDTH);
  const int blocks_a_line = side / width;
  const int first_along = int(block.block) % blocks_a_line * width;
  const int first_across = int(block.block) / blocks_a_line * LINES;
  const ivec2 thread = texel_at(int(gl_LocalInvocationIndex) % 16, int(gl_LocalInvocationIndex) / 16);
  for (int along = thread.x; along < width + 2 * REACH; along += 16) {
    const ivec2 texel = texel_at(first_along + along - REACH, first_across + thread.y);
    s_texels[place_of(along, thread.y)] = blur_source(block.light, shadow_texel(block.light, block.square, texel));
  }
  barrier();  // all lines are there
  const int step = blur_step(side);
  for (int along = thread.x; along < width; along += 16) {
    vec4 sum = vec4(0.0);
    for (int tap = 0; tap < 9; ++tap) {
      precise const vec4 added = s_texels[place_of(REACH + along + (tap - 4) * step, thread.y)] * BLUR_WEIGHTS[tap];
      sum += added;
    }
    const ivec2 texel = texel_at(first_along + along, first_across + thread.y);
    imageStore(blurred, shadow_texel(block.light, block.square, texel), sum);
  }
}
