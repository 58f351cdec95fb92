// A pass of the blur as the article's listing has it, to show what its indices do: a group of 16 x 16 threads shares a line
// of 256 texels and the 24 behind them, as if it lay along that line. But the line's texels are those of 16 lines of the
// square, one behind the other, so a tap beyond the 16th is in the next.
// Based on: Adventures in Deferred Rendering: Tiled Deferred Shading and Compute Shaders: weights, taps three texels apart.
// Promise: no texel of another square is read: taps end at the edge of a square, or fold across that of an octahedron.
// Needs: BLUR_ALONG_X, 1 for the first pass, which reads depths, 0 for the second, which reads what the first wrote.
// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/blur_block.glsl"

const int THREADS = 256;
layout(local_size_x = THREADS) in;

const int LINES = int(LEAST_SQUARE);
shared BLUR_VECTOR s_texels[THREADS + 2 * MOST_REACH];

// `texel`: of the square.
#if BLUR_ALONG_X
const ivec2 ALONG = ivec2(1, 0);
BLUR_VECTOR source_at(BlurBlock block, ivec2 texel) {
  const float stored = SHADOW_TEXEL(shadow_atlas, shadow_texel_of(block.square, texel)).x;
  return BLUR_VECTOR(shadow_moments_of_depth(shadow_unit_depth_of_stored(block.depths, stored)));
}
#else
const ivec2 ALONG = ivec2(0, 1);
BLUR_VECTOR source_at(BlurBlock block, ivec2 texel) {
  return BLUR_VECTOR(SHADOW_TEXEL(shadow_moments, shadow_texel_of(block.square, texel)));
}
#endif

// A thread begins as far before its texel as the first tap, along the direction of the pass.
void blur_block(BlurBlock block) {
  const int side = block.square.side;
  const int thread = int(gl_LocalInvocationIndex);
  const int groups_a_line = side / LINES;
  const ivec2 group = ivec2(block.number % groups_a_line, block.number / groups_a_line);
  const ivec2 texel = LINES * group + ivec2(thread % LINES, thread / LINES);
  const int step = blur_step(side);
  const ivec2 start = texel - 4 * step * ALONG;
  s_texels[thread] = source_at(block, clamp(start, 0, side - 1));
  if (thread < 8 * step) s_texels[THREADS + thread] = source_at(block, clamp(start + THREADS * ALONG, 0, side - 1));
  barrier();  // the whole line is there
  BLUR_VECTOR sum = BLUR_VECTOR(0.0);
  [[unroll]] for (int tap = 0; tap < TAPS; ++tap)
    sum = fma(s_texels[thread + tap * step], BLUR_VECTOR(BLUR_WEIGHTS[tap]), sum);
  blur_store(block, texel, sum);
}
