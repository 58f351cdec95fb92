// A pass of the separable Gaussian of nine taps along one direction, over the squares that were drawn, each by itself: a
// work group takes 16 lines of up to 64 texels of a square, with what their taps reach beside them in shared memory. Or,
// to show what it does, by the article's indices: a group of 16 x 16 shares a line of 256 texels and the 24 behind them,
// as if it lay along that line.
// Based on: Adventures in Deferred Rendering: Tiled Deferred Shading and Compute Shaders: weights, taps three texels apart.
// Promise: no texel of another square is read: taps end at the edge of a square, or fold across that of an octahedron.
// Needs: BLUR_ALONG_X (bool), BLUR_FORMAT, BLUR_VECTOR, vec4 blur_source(ShadowDepths, ivec2 texel of the atlas).
// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/blur_block.glsl"

const int THREADS = 256;
layout(local_size_x = THREADS) in;

layout(constant_id = 1) const bool BY_LISTING = false;

const int LINES = int(LEAST_SQUARE);
const int MOST_WIDTH = 64;
const int MOST_WIDE = MOST_WIDTH + 2 * MOST_REACH;
const int TEXELS_A_THREAD = (MOST_WIDE + LINES - 1) / LINES;
shared BLUR_VECTOR s_texels[LINES * MOST_WIDE];

ivec2 texel_at(int along, int across) { return BLUR_ALONG_X ? ivec2(along, across) : ivec2(across, along); }

// Neighbours of the atlas lie side by side.
int place_of(int along, int across) { return BLUR_ALONG_X ? across * MOST_WIDE + along : along * LINES + across; }

BLUR_VECTOR source_at(BlurBlock block, ivec2 texel) {
  return BLUR_VECTOR(blur_source(block.depths, shadow_texel_of(block.square, texel)));
}

void blur_by_line(BlurBlock block) {
  const int side = block.square.side;
  const int width = min(side, MOST_WIDTH);
  const int blocks_a_line = side / width;
  const int first_along = block.number % blocks_a_line * width;
  const int first_across = block.number / blocks_a_line * LINES;
  const int step = blur_step(side);
  const ivec2 thread = texel_at(int(gl_LocalInvocationIndex) % LINES, int(gl_LocalInvocationIndex) / LINES);
  const int reach = 4 * step;
  const int wide = width + 2 * reach;
  // All texels of a thread are asked for before the first is waited for.
  BLUR_VECTOR texels[TEXELS_A_THREAD];
  [[unroll]] for (int i = 0; i < TEXELS_A_THREAD; ++i)
    if (thread.x + i * LINES < wide)
      texels[i] = source_at(block, texel_at(first_along + thread.x + i * LINES - reach, first_across + thread.y));
  [[unroll]] for (int i = 0; i < TEXELS_A_THREAD; ++i)
    if (thread.x + i * LINES < wide) s_texels[place_of(thread.x + i * LINES, thread.y)] = texels[i];
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
void blur_by_listing(BlurBlock block) {
  const int side = block.square.side;
  const int thread = int(gl_LocalInvocationIndex);
  const int groups_a_line = side / LINES;
  const ivec2 group = ivec2(block.number % groups_a_line, block.number / groups_a_line);
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

void blur_block(BlurBlock block) {
  if (BY_LISTING)
    blur_by_listing(block);
  else
    blur_by_line(block);
}
