// How threads of the blur share a strip of a square, of up to 64 columns: each thread has a column, and walks down some of
// its rows.
// Needs: THREADS, of a group: a multiple of 64.
// SPDX-License-Identifier: Apache-2.0
#ifndef BLUR_STRIP
#define BLUR_STRIP
#include "shadow/parts/blur_block.glsl"

layout(local_size_x = THREADS) in;

const int MOST_COLUMNS = 64;
const int MOST_ROWS = 128;

struct Strip {
  ivec2 first;  // texel of the square
  ivec2 size;
  int step;      // texels between taps
  int reach;     // texels, to the farthest tap
  int residues;  // parts that take turns with rows
  int parts;     // that walk down at once: where a square has fewer columns, there are more
  int rows;      // of a slice, which `residues` parts have
};

// What of a strip is a thread's.
struct Column {
  int x;        // in the strip
  int part;
  ivec2 place;  // of the square: where it begins
  int end;      // behind the last row of its part
};

// With so many parts that take turns with rows, or all of them.
Strip strip_of(BlurBlock block, int most_residues) {
  const int side = block.square.side;
  Strip strip;
  strip.size = ivec2(min(side, MOST_COLUMNS), min(side, MOST_ROWS));
  const int strips_a_line = side / strip.size.x;
  strip.first = strip.size * ivec2(block.number % strips_a_line, block.number / strips_a_line);
  strip.step = blur_step(side);
  strip.reach = 4 * strip.step;
  strip.parts = THREADS / strip.size.x;
  strip.residues = min(most_residues, strip.parts);
  const int slices = strip.parts / strip.residues;
  strip.rows = (strip.size.y + slices - 1) / slices;
  return strip;
}

// Of the square, without taps; a part's next rows are `residues` below.
int first_row(Strip strip, int part) {
  return strip.first.y + part / strip.residues * strip.rows + part % strip.residues;
}

Column column_of(Strip strip) {
  Column column;
  column.x = int(gl_LocalInvocationIndex) % strip.size.x;
  column.part = int(gl_LocalInvocationIndex) / strip.size.x;
  column.place = ivec2(strip.first.x + column.x, first_row(strip, column.part));
  column.end = strip.first.y + min((column.part / strip.residues + 1) * strip.rows, strip.size.y);
  return column;
}

#endif
