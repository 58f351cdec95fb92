// Blurs rows of a strip along x: the group shares depths of some rows for each of its parts, and each thread takes nine of
// a row. They are asked for a turn before they are shared.
// Needs: THREADS; TURN_ROWS, rows that a part shares at once; BLUR_SOURCE (float or vec2), what is shared of a texel;
// BLUR_SOURCE blur_source(float unit_depth), BLUR_VECTOR blur_moments(BLUR_SOURCE).
// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/blur_strip.glsl"

const int MOST_SHARED = TURN_ROWS * THREADS / MOST_COLUMNS * (MOST_COLUMNS + 2 * MOST_REACH);  // of smaller squares less
const int LOADS = (MOST_SHARED + THREADS - 1) / THREADS;
shared BLUR_SOURCE s_texels[2][MOST_SHARED];

// Texels of a row, with those that taps reach.
int wide_of(Strip strip) { return strip.size.x + 2 * strip.reach; }

// What a thread has of the rows that the group shares next: as they are stored, so that nothing waits for them yet.
struct Loads {
  ivec2 texel[LOADS];
  float stored[LOADS];
};

bool has_load(Strip strip, int i) {
  return int(gl_LocalInvocationIndex) + i * THREADS < TURN_ROWS * strip.parts * wide_of(strip);
}

void load(BlurBlock block, Strip strip, inout Loads loads) {
  [[unroll]] for (int i = 0; i < LOADS; ++i) {
    if (!has_load(strip, i)) continue;
    loads.stored[i] = SHADOW_TEXEL(shadow_atlas, shadow_texel_of(block.square, loads.texel[i])).x;
    loads.texel[i].y += TURN_ROWS * strip.residues;
  }
}

// `above`: rows above the strip that are blurred as well.
Loads first_loads(BlurBlock block, Strip strip, int above) {
  Loads loads;
  const int wide = wide_of(strip);
  [[unroll]] for (int i = 0; i < LOADS; ++i) {
    const int n = int(gl_LocalInvocationIndex) + i * THREADS;
    const int row = n / wide;
    loads.texel[i] = ivec2(strip.first.x - strip.reach + n % wide,
                           first_row(strip, row / TURN_ROWS) + row % TURN_ROWS * strip.residues - above);
  }
  load(block, strip, loads);
  return loads;
}

// Shares what was loaded, and asks for the next rows.
void share(BlurBlock block, Strip strip, int turn, inout Loads loads) {
  [[unroll]] for (int i = 0; i < LOADS; ++i)
    if (has_load(strip, i))
      s_texels[turn & 1][int(gl_LocalInvocationIndex) + i * THREADS] =
          blur_source(shadow_unit_depth_of_stored(block.depths, loads.stored[i]));
  barrier();  // the rows are there, and those before the last are read
  load(block, strip, loads);
}

BLUR_VECTOR nine_taps(int turn, int first, int step) {
  BLUR_VECTOR sum = BLUR_VECTOR(0.0);
  [[unroll]] for (int tap = 0; tap < TAPS; ++tap)
    sum = fma(blur_moments(s_texels[turn & 1][first + tap * step]), BLUR_VECTOR(BLUR_WEIGHTS[tap]), sum);
  return sum;
}

// `row`: of the part's, in this turn. Nearly all squares have a step of 3: known, it needs no additions.
BLUR_VECTOR along_x(Strip strip, Column column, int turn, int row) {
  const int first = (column.part * TURN_ROWS + row) * wide_of(strip) + column.x;
  return strip.step == 3 ? nine_taps(turn, first, 3) : nine_taps(turn, first, strip.step);
}
