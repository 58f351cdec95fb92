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
  const int column = int(gl_LocalInvocationIndex) % strip.size.x;
  const int part = int(gl_LocalInvocationIndex) / strip.size.x;
  const int end = end_row(strip, part);
  const int turns = (strip.rows + strip.residues - 1) / strip.residues;
  ivec2 place = ivec2(strip.first.x + column, first_row(strip, part));
  Loads loads = first_loads(block, strip, 0);
  for (int turn = 0; turn * TURN_ROWS < turns; ++turn) {
    share(block, strip, turn, loads);
    for (int row = 0; row < TURN_ROWS; ++row, place.y += strip.residues)
      if (place.y < end) blur_store(block, place, along_x(strip, part, column, turn, row));
  }
}
