// A pass of the separable Gaussian of nine taps along one direction, over the squares that were drawn, each by itself: a
// work group takes 16 lines of up to 64 texels of a square, with what their taps reach beside them in shared memory. Or,
// to show what it does, by the article's indices: a group of 16 x 16 shares a line of 256 texels and the 24 behind them,
// as if it lay along that line.
// Based on: Adventures in Deferred Rendering: Tiled Deferred Shading and Compute Shaders: weights, taps three texels apart.
// Promise: no texel of another square is read: taps end at the edge of a square, or fold across that of an octahedron.
// Needs: BLUR_ALONG_X (bool), BLUR_FORMAT, BLUR_VECTOR (vec2 or vec4, moments of a texel),
// vec4 blur_source(uint light, ivec2 texel of the atlas).
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
layout(constant_id = 1) const bool BY_LISTING = false;

const int TAPS = 9;
const int MOST_REACH = 12;  // texels, to the farthest tap
const int LINES = int(LEAST_SQUARE);
const int MOST_WIDTH = 64;
const int MOST_WIDE = MOST_WIDTH + 2 * MOST_REACH;
shared BLUR_VECTOR s_texels[LINES * MOST_WIDE];

ivec2 texel_at(int along, int across) { return BLUR_ALONG_X ? ivec2(along, across) : ivec2(across, along); }

// Neighbours of the atlas lie side by side.
int place_of(int along, int across) { return BLUR_ALONG_X ? across * MOST_WIDE + along : along * LINES + across; }

BLUR_VECTOR source_at(BlurBlock block, ivec2 texel) {
  return BLUR_VECTOR(blur_source(block.light, shadow_texel(block.light, block.square, texel)));
}

void blur_store(BlurBlock block, ivec2 texel, BLUR_VECTOR moments) {
  vec4 stored = vec4(0.0);
  [[unroll]] for (int i = 0; i < moments.length(); ++i) stored[i] = moments[i];
  imageStore(blurred, shadow_texel(block.light, block.square, texel), stored);
}

void blur_block(BlurBlock block, int side) {
  const int width = min(side, MOST_WIDTH);
  const int blocks_a_line = side / width;
  const int first_along = int(block.block) % blocks_a_line * width;
  const int first_across = int(block.block) / blocks_a_line * LINES;
  const int step = blur_step(side);
  const ivec2 thread = texel_at(int(gl_LocalInvocationIndex) % LINES, int(gl_LocalInvocationIndex) / LINES);
  const int reach = 4 * step;
  for (int along = thread.x; along < width + 2 * reach; along += LINES)
    s_texels[place_of(along, thread.y)] =
        source_at(block, texel_at(first_along + along - reach, first_across + thread.y));
  barrier();  // all lines are there
  for (int along = thread.x; along < width; along += LINES) {
    BLUR_VECTOR sum = BLUR_VECTOR(0.0);
    [[unroll]] for (int tap = 0; tap < TAPS; ++tap)
      sum = fma(s_texels[place_of(along + tap * step, thread.y)], BLUR_VECTOR(BLUR_WEIGHTS[tap]), sum);
    blur_store(block, texel_at(first_along + along, first_across + thread.y), sum);
  }
}

// The line's texels are those of 16 lines of the square, one behind the other, so a tap beyond the 16th is in the next. A
// thread begins as far before its texel as the first tap, along the direction of the pass.
void blur_by_listing(BlurBlock block, int side) {
  const int thread = int(gl_LocalInvocationIndex);
  const int groups_a_line = side / LINES;
  const ivec2 group = ivec2(int(block.block) % groups_a_line, int(block.block) / groups_a_line);
  const ivec2 texel = LINES * group + ivec2(thread % LINES, thread / LINES);
  const int step = blur_step(side);
  const ivec2 start = texel - texel_at(4 * step, 0);
  s_texels[thread] = source_at(block, clamp(start, 0, side - 1));
  if (thread < 8 * step) s_texels[THREADS + thread] = source_at(block, clamp(start + texel_at(THREADS, 0), 0, side - 1));
  barrier();  // the whole line is there
  BLUR_VECTOR sum = BLUR_VECTOR(0.0);
  [[unroll]] for (int tap = 0; tap < TAPS; ++tap)
    sum = fma(s_texels[thread + tap * step], BLUR_VECTOR(BLUR_WEIGHTS[tap]), sum);
  blur_store(block, texel, sum);
}

void main() {
  const uint number = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  if (number >= block_count) return;
  const BlurBlock block = blocks[number];
  const int side = int(shadow_maps[block.light].side);
  if (BY_LISTING)
    blur_by_listing(block, side);
  else
    blur_block(block, side);
}
