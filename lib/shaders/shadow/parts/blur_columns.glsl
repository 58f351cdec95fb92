// Sums of a thread that walks down its column: those of the nine texels that have the row as a tap along y. Taps are three
// rows apart, so of three rows each is another thread's.
// Needs: THREADS.
// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/blur_strip.glsl"

Strip strip_of_columns(BlurBlock block) { return strip_of(block, max(blur_step(block.square.side), 1)); }

struct ColumnSums {
  Column column;              // its place is that of the texel whose last tap comes next
  int turns;                  // until the last row is whole
  BLUR_VECTOR of_taps[TAPS];  // of one tap, of two, ...: the last is whole
};

ColumnSums begin_sums(Strip strip) {
  ColumnSums sums;
  sums.column = column_of(strip);
  sums.column.place.y -= 2 * strip.reach;
  sums.turns = (strip.rows + 2 * strip.reach + strip.residues - 1) / strip.residues;
  [[unroll]] for (int tap = 0; tap < TAPS; ++tap) sums.of_taps[tap] = BLUR_VECTOR(0.0);
  return sums;
}

void add_row(BlurBlock block, Strip strip, int turn, BLUR_VECTOR texel, inout ColumnSums sums) {
  const bool one_row = strip.step == 0;  // of all taps
  [[unroll]] for (int tap = TAPS - 1; tap > 0; --tap)
    sums.of_taps[tap] = fma(texel, BLUR_VECTOR(BLUR_WEIGHTS[tap]), sums.of_taps[tap - 1]);
  sums.of_taps[0] = texel * BLUR_WEIGHTS[0];
  if (one_row) [[unroll]] for (int tap = 1; tap < TAPS; ++tap)
      sums.of_taps[tap] = fma(texel, BLUR_VECTOR(BLUR_WEIGHTS[tap]), sums.of_taps[tap - 1]);
  if (sums.column.place.y < sums.column.end && (turn >= TAPS - 1 || one_row))
    blur_store(block, sums.column.place, sums.of_taps[TAPS - 1]);
  sums.column.place.y += strip.residues;
}
