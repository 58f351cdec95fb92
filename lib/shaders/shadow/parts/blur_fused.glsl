// Both directions of the separable Gaussian of nine taps in one pass, with no image between them: a work group walks down
// a strip. It blurs a row along x, and adds that to the sums along y.
// Based on: Adventures in Deferred Rendering: Tiled Deferred Shading and Compute Shaders: weights, taps three texels apart.
// Promise: the numbers of the two passes, blur_along_x.glsl and blur_along_y.glsl, but for the order of sums beyond folds
// of an octahedron.
// Needs: TURN_ROWS, of blur_rows.glsl.
// SPDX-License-Identifier: Apache-2.0
const int THREADS = 192;
#include "shadow/parts/blur_rows.glsl"
#include "shadow/parts/blur_columns.glsl"

void blur_block(BlurBlock block) {
  const Strip strip = strip_of_columns(block);
  ColumnSums sums = begin_sums(strip);
  Loads loads = first_loads(block, strip, strip.reach);
  for (int turn = 0; turn * TURN_ROWS < sums.turns; ++turn) {
    share(block, strip, turn, loads);
    for (int row = 0; row < TURN_ROWS; ++row)
      add_row(block, strip, turn * TURN_ROWS + row, along_x(strip, sums.column, turn, row), sums);
  }
}
