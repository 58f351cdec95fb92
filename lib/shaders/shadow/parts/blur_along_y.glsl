// The second of two passes of the separable Gaussian of nine taps: along y, what the first wrote. Threads that lie side by
// side walk down columns side by side, so nothing needs to be shared.
// Based on: Adventures in Deferred Rendering: Tiled Deferred Shading and Compute Shaders: weights, taps three texels apart.
// Promise: no texel of another square is read: taps end at the edge of a square, or fold across that of an octahedron.
// SPDX-License-Identifier: Apache-2.0
const int THREADS = 192;
#include "shadow/parts/blur_columns.glsl"

const int AHEAD = 2;  // rows that are asked for before the first of them is waited for

void blur_block(BlurBlock block) {
  const Strip strip = strip_of_columns(block);
  ColumnSums sums = begin_sums(strip);
  for (int first = 0; first < sums.turns; first += AHEAD) {
    BLUR_VECTOR texels[AHEAD];
    [[unroll]] for (int i = 0; i < AHEAD; ++i) {
      const ivec2 texel = sums.column.place + ivec2(0, strip.reach + i * strip.residues);
      texels[i] = BLUR_VECTOR(SHADOW_TEXEL(shadow_moments, shadow_texel_of(block.square, texel)));
    }
    [[unroll]] for (int i = 0; i < AHEAD; ++i)
      if (first + i < sums.turns) add_row(block, strip, first + i, texels[i], sums);
  }
}
