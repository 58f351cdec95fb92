// The blur in one pass: a work group has 32 x 32 texels of a square and what their taps reach around them, blurs along x
// into shared memory, and along y from there.
// Needs: as blur_block.glsl. SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/blur_block.glsl"

// A thread makes four results of a line, a step apart, which have most of their taps in common.
const int CHUNK = 4;
const int TAKEN = CHUNK + TAPS - 1;

int chunks_of(int width, int step) { return (width + CHUNK * step - 1) / (CHUNK * step) * step; }
int chunk_begin(int chunk, int step) { return chunk / step * (CHUNK * step) + chunk % step; }

const int TILE = 32;
const int MOST_WIDE = TILE + 2 * MOST_REACH;
const int VALUE_PITCH = 67;  // values from line to line: so that threads with a chunk of nine lie in banks of their own
const int LINE_PITCH = TILE + 3;                      // likewise
const int MOST_LINES = MOST_WIDE + (CHUNK - 1);       // the last chunk takes more than it has results for
const int ROUNDS = 2;                                 // chunks of a thread, at most
const int PAIRS = BLUR_VECTOR(0.0).length() / 2;      // of a value and its square
shared float s_values[MOST_WIDE * VALUE_PITCH];       // of the texels
shared vec2 s_lines[(MOST_LINES + 1) * LINE_PITCH];   // moments, blurred along x

float unit_depth_at(BlurBlock block, ivec2 texel) {
  const ivec2 at = shadow_texel(block.light, block.square, texel);
  return shadow_unit_depth_of_stored(block.light, SHADOW_TEXEL(shadow_atlas, at).x);
}

// Of which a pair of moments is made.
float value_of(float unit_depth, int pair) {
  return PAIRS == 1 ? unit_depth : shadow_warped(unit_depth)[pair];
}

void load_values(BlurBlock block, ivec2 first, int wide, int pair) {
  for (int i = int(gl_LocalInvocationIndex); i < wide * wide; i += THREADS) {
    const ivec2 at = ivec2(i % wide, i / wide);
    s_values[at.y * VALUE_PITCH + at.x] = value_of(unit_depth_at(block, first + at), pair);
  }
}

void blur_along_x(int wide, int step) {
  const int chunks = chunks_of(TILE, step);
  for (int i = int(gl_LocalInvocationIndex); i < wide * chunks; i += THREADS) {
    const int line = i / chunks;
    const int begin = chunk_begin(i % chunks, step);
    vec2 taken[TAKEN];
    [[unroll]] for (int k = 0; k < TAKEN; ++k) {
      const float value = s_values[line * VALUE_PITCH + begin + k * step];
      taken[k] = vec2(value, value * value);
    }
    [[unroll]] for (int k = 0; k < CHUNK; ++k) {
      vec2 sum = vec2(0.0);
      [[unroll]] for (int tap = 0; tap < TAPS; ++tap) sum = fma(taken[k + tap], vec2(BLUR_WEIGHTS[tap]), sum);
      if (begin + k * step < TILE) s_lines[line * LINE_PITCH + begin + k * step] = sum;
    }
  }
}

void blur_along_y(int chunk, int column, int step, out vec2 sums[CHUNK]) {
  const int begin = chunk_begin(chunk, step);
  vec2 taken[TAKEN];
  [[unroll]] for (int k = 0; k < TAKEN; ++k) taken[k] = s_lines[(begin + k * step) * LINE_PITCH + column];
  [[unroll]] for (int k = 0; k < CHUNK; ++k) {
    sums[k] = vec2(0.0);
    [[unroll]] for (int tap = 0; tap < TAPS; ++tap) sums[k] = fma(taken[k + tap], vec2(BLUR_WEIGHTS[tap]), sums[k]);
  }
}

void blur_tile(BlurBlock block, ivec2 first, int step) {
  const int thread = int(gl_LocalInvocationIndex);
  const int wide = TILE + 8 * step;
  const int items = TILE * chunks_of(TILE, step);
  BLUR_VECTOR results[ROUNDS][CHUNK];
  [[unroll]] for (int pair = 0; pair < PAIRS; ++pair) {
    load_values(block, first - 4 * step, wide, pair);
    barrier();  // all values before they are taken, and lines of the pair before have been
    blur_along_x(wide, step);
    barrier();  // all lines before they are taken, and values have been
    [[unroll]] for (int round = 0; round < ROUNDS; ++round) {
      const int item = round * THREADS + thread;
      vec2 sums[CHUNK];
      if (item < items) blur_along_y(item / TILE, item % TILE, step, sums);
      [[unroll]] for (int k = 0; k < CHUNK; ++k) {
        results[round][k][2 * pair] = sums[k].x;
        results[round][k][2 * pair + 1] = sums[k].y;
      }
    }
  }
  [[unroll]] for (int round = 0; round < ROUNDS; ++round)
    [[unroll]] for (int k = 0; k < CHUNK; ++k) {
      const int item = round * THREADS + thread;
      const ivec2 texel = ivec2(item % TILE, chunk_begin(item / TILE, step) + k * step);
      if (item < items && texel.y < TILE) blur_store(block, first + texel, results[round][k]);
    }
}

// A square without taps: its moments are those of its texels.
void store_moments(BlurBlock block, int side) {
  for (int i = int(gl_LocalInvocationIndex); i < side * side; i += THREADS) {
    const ivec2 texel = ivec2(i % side, i / side);
    blur_store(block, texel, BLUR_VECTOR(shadow_moments_of_depth(unit_depth_at(block, texel))));
  }
}

void main() {
  if (group_number() >= block_count) return;
  const BlurBlock block = blocks[group_number()];
  const int side = int(shadow_maps[block.light].side);
  const int step = blur_step(side);
  if (step == 0) {
    store_moments(block, side);
    return;
  }
  const int across = side / TILE;
  blur_tile(block, TILE * ivec2(int(block.block) % across, int(block.block) / across), step);
}
