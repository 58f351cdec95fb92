// Both directions of the separable Gaussian of nine taps in one pass, with no image between them: a work group walks down
// a strip of up to 64 columns. It shares the depths of a row, each thread blurs a texel of it along x, and adds that to
// the sums along y of the nine texels of its column that have the row as a tap. Taps are three rows apart, so of three
// rows each is another thread's; in small squares, which have fewer columns, threads walk down parts of them at once.
// Based on: Adventures in Deferred Rendering: Tiled Deferred Shading and Compute Shaders: weights, taps three texels apart.
// Promise: the numbers of the two passes of blur_lines.glsl, but for the order of sums beyond folds of an octahedron.
// Needs: BLUR_FORMAT, BLUR_VECTOR; BLUR_SOURCE (float or vec2), what is shared of a texel;
// BLUR_SOURCE blur_source(float unit_depth), BLUR_VECTOR blur_moments(BLUR_SOURCE).
// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/blur_block.glsl"

const int THREADS = 192;
layout(local_size_x = THREADS) in;

const int MOST_COLUMNS = 64;
const int MOST_ROWS = 128;
const int MOST_SHARED = THREADS / MOST_COLUMNS * (MOST_COLUMNS + 2 * MOST_REACH);  // of smaller squares it is less
const int LOADS = (MOST_SHARED + THREADS - 1) / THREADS;
shared BLUR_SOURCE s_texels[2][MOST_SHARED];

// How the threads of a group share a strip: `parts` walk down at once, each with rows of its own.
struct Strip {
  ivec2 first;  // texel of the square
  ivec2 size;
  int step;      // rows between taps
  int reach;     // texels, to the farthest tap
  int residues;  // parts that take turns with rows
  int parts;
  int rows;  // of a slice, which `residues` parts have
  int wide;  // texels of a row, with those that taps reach
};

Strip strip_of(BlurBlock block) {
  const int side = block.square.side;
  Strip strip;
  strip.size = ivec2(min(side, MOST_COLUMNS), min(side, MOST_ROWS));
  const int strips_a_line = side / strip.size.x;
  strip.first = strip.size * ivec2(block.number % strips_a_line, block.number / strips_a_line);
  strip.step = blur_step(side);
  strip.reach = 4 * strip.step;
  strip.residues = max(strip.step, 1);
  strip.parts = THREADS / strip.size.x;
  const int slices = strip.parts / strip.residues;
  strip.rows = (strip.size.y + slices - 1) / slices;
  strip.wide = strip.size.x + 2 * strip.reach;
  return strip;
}

// Of the square; a part's next rows are `residues` below.
int first_row(Strip strip, int part) {
  return strip.first.y - strip.reach + part / strip.residues * strip.rows + part % strip.residues;
}

// What a thread has of the rows that the group shares next: as they are stored, so that nothing waits for them yet.
struct Loads {
  ivec2 texel[LOADS];
  float stored[LOADS];
};

bool has_load(Strip strip, int i) {
  return int(gl_LocalInvocationIndex) + i * THREADS < strip.parts * strip.wide;
}

Loads first_loads(Strip strip) {
  Loads loads;
  [[unroll]] for (int i = 0; i < LOADS; ++i) {
    const int n = int(gl_LocalInvocationIndex) + i * THREADS;
    loads.texel[i] = ivec2(strip.first.x - strip.reach + n % strip.wide, first_row(strip, n / strip.wide));
  }
  return loads;
}

void load(BlurBlock block, Strip strip, inout Loads loads) {
  [[unroll]] for (int i = 0; i < LOADS; ++i) {
    if (!has_load(strip, i)) continue;
    loads.stored[i] = SHADOW_TEXEL(shadow_atlas, shadow_texel_of(block.square, loads.texel[i])).x;
    loads.texel[i].y += strip.residues;
  }
}

void share(BlurBlock block, Strip strip, Loads loads, int turn) {
  [[unroll]] for (int i = 0; i < LOADS; ++i)
    if (has_load(strip, i))
      s_texels[turn & 1][int(gl_LocalInvocationIndex) + i * THREADS] =
          blur_source(shadow_unit_depth_of_stored(block.depths, loads.stored[i]));
}

BLUR_VECTOR blurred_along_x(Strip strip, int turn, int first) {
  BLUR_VECTOR sum = BLUR_VECTOR(0.0);
  [[unroll]] for (int tap = 0; tap < TAPS; ++tap)
    sum = fma(blur_moments(s_texels[turn & 1][first + tap * strip.step]), BLUR_VECTOR(BLUR_WEIGHTS[tap]), sum);
  return sum;
}

void blur_block(BlurBlock block) {
  const Strip strip = strip_of(block);
  const int thread = int(gl_LocalInvocationIndex);
  const int column = thread % strip.size.x;
  const int part = thread / strip.size.x;
  const int end = strip.first.y + min((part / strip.residues + 1) * strip.rows, strip.size.y);
  const int turns = (strip.rows + 2 * strip.reach + strip.residues - 1) / strip.residues;
  int row = first_row(strip, part) - strip.reach;  // of the middle tap
  const bool one_row = strip.step == 0;            // of all taps
  BLUR_VECTOR sums[TAPS];                          // of one tap, of two, ...: the last is whole
  [[unroll]] for (int tap = 0; tap < TAPS; ++tap) sums[tap] = BLUR_VECTOR(0.0);
  Loads loads = first_loads(strip);
  load(block, strip, loads);
  for (int turn = 0; turn < turns; ++turn) {
    share(block, strip, loads, turn);
    barrier();  // the rows are there, and those before the last are read
    load(block, strip, loads);
    const BLUR_VECTOR along_x = blurred_along_x(strip, turn, part * strip.wide + column);
    [[unroll]] for (int tap = TAPS - 1; tap > 0; --tap)
      sums[tap] = fma(along_x, BLUR_VECTOR(BLUR_WEIGHTS[tap]), sums[tap - 1]);
    sums[0] = along_x * BLUR_WEIGHTS[0];
    if (one_row) [[unroll]] for (int tap = 1; tap < TAPS; ++tap)
        sums[tap] = fma(along_x, BLUR_VECTOR(BLUR_WEIGHTS[tap]), sums[tap - 1]);
    if (row < end && (turn >= TAPS - 1 || one_row))
      blur_store(block, ivec2(strip.first.x + column, row), sums[TAPS - 1]);
    row += strip.residues;
  }
}
