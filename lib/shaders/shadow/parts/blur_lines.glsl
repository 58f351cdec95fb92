// A pass of the blur along one direction: a work group takes 16 lines of up to 64 texels of a square, with what their
// taps reach beside them in shared memory. Or, to show what it does, by the article's indices: a group of 16 x 16 shares
// a line of 256 texels and the 24 behind them, as if it lay along that line.
// Needs: as blur_block.glsl; BLUR_ALONG_X (bool), vec4 blur_source(BlurSquare s, ivec2 texel of the atlas).
// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/blur_block.glsl"

layout(constant_id = 1) const bool BY_LISTING = false;

const int LINES = int(LEAST_SQUARE);
const int MOST_WIDTH = 64;
const int MOST_WIDE = MOST_WIDTH + 2 * MOST_REACH;
shared BLUR_VECTOR s_texels[LINES * MOST_WIDE];

ivec2 texel_at(int along, int across) { return BLUR_ALONG_X ? ivec2(along, across) : ivec2(across, along); }

// Neighbours of the atlas lie side by side.
int place_of(int along, int across) { return BLUR_ALONG_X ? across * MOST_WIDE + along : along * LINES + across; }

BLUR_VECTOR source_at(BlurSquare s, ivec2 texel) { return BLUR_VECTOR(blur_source(s, blur_texel(s, texel))); }

void blur_block(BlurSquare s, int block) {
  const int width = min(s.side, MOST_WIDTH);
  const int first_along = block % (s.side / width) * width;
  const int first_across = block / (s.side / width) * LINES;
  const int step = blur_step(s.side);
  const ivec2 thread = texel_at(int(gl_LocalInvocationIndex) % LINES, int(gl_LocalInvocationIndex) / LINES);
  const int reach = 4 * step;
  for (int along = thread.x; along < width + 2 * reach; along += LINES)
    s_texels[place_of(along, thread.y)] =
        source_at(s, texel_at(first_along + along - reach, first_across + thread.y));
  barrier();  // all lines are there
  for (int along = thread.x; along < width; along += LINES) {
    BLUR_VECTOR sum = BLUR_VECTOR(0.0);
    [[unroll]] for (int tap = 0; tap < TAPS; ++tap)
      sum = fma(s_texels[place_of(along + tap * step, thread.y)], BLUR_VECTOR(BLUR_WEIGHTS[tap]), sum);
    blur_store(s, texel_at(first_along + along, first_across + thread.y), sum);
  }
}

// Where the article's thread begins: as far before its texel as the first tap, along the direction of the pass.
ivec2 start_of(ivec2 first, int thread, int step) {
  return first + ivec2(thread % LINES, thread / LINES) - texel_at(4 * step, 0);
}

// The line's texels are those of 16 lines of the square, one behind the other, so a tap beyond the 16th is in the next.
void blur_by_listing(BlurSquare s, int block) {
  const ivec2 first = LINES * ivec2(block % (s.side / LINES), block / (s.side / LINES));
  const int thread = int(gl_LocalInvocationIndex);
  const int step = blur_step(s.side);
  const ivec2 start = start_of(first, thread, step);
  s_texels[thread] = source_at(s, clamp(start, 0, s.side - 1));
  if (thread < 8 * step) s_texels[THREADS + thread] = source_at(s, clamp(start + texel_at(THREADS, 0), 0, s.side - 1));
  barrier();  // the whole line is there
  BLUR_VECTOR sum = BLUR_VECTOR(0.0);
  [[unroll]] for (int tap = 0; tap < TAPS; ++tap)
    sum = fma(s_texels[thread + tap * step], BLUR_VECTOR(BLUR_WEIGHTS[tap]), sum);
  blur_store(s, first + ivec2(thread % LINES, thread / LINES), sum);
}

void main() {
  if (group_number() >= block_count) return;
  const BlurSquare square = blur_square(blocks[group_number()]);
  const int block = int(blocks[group_number()].block);
  if (BY_LISTING)
    blur_by_listing(square, block);
  else
    blur_block(square, block);
}
