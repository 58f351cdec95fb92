// The first of two passes of the separable Gaussian of nine taps: along x, moments of depths. A work group walks down a
// strip.
// Based on: Adventures in Deferred Rendering: Tiled Deferred Shading and Compute Shaders: weights, taps three texels apart.
// Promise: no texel of another square is read: taps end at the edge of a square, or fold across that of an octahedron.
// SPDX-License-Identifier: Apache-2.0
const int THREADS = 256;
const int TURN_ROWS = 4;
#include "shadow/parts/blur_rows.glsl"

void blur_block(BlurBlock block) {
  const Strip strip = strip_of(block, THREADS);
  Column column = column_of(strip);
  const int turns = (strip.rows + strip.residues - 1) / strip.residues;
  Loads loads = first_loads(block, strip, 0);
  for (int turn = 0; turn * TURN_ROWS < turns; ++turn) {
    share(block, strip, turn, loads);
    for (int row = 0; row < TURN_ROWS; ++row, column.place.y += strip.residues)
      if (column.place.y < column.end) blur_store(block, column.place, along_x(strip, column, turn, row));
  }
}
