// The cells of a radial bound while a work group makes them: an area of them is raised to what a block of texels reaches.
// Needs: gl_WorkGroupSize; shadow/parts/radial_cells.glsl.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_SHADOW_RADIAL_RAISE
#define LAMP_SHADOW_RADIAL_RAISE

const uint CELLS = RADIAL_SIDE * RADIAL_SIDE / 3u * 4u;  // of all levels and more
shared uint s_cells[CELLS];

// Where an area ends that has not crossed a fold, from its first cell on.
int last_before_fold(int first, int last) {
  const int side = int(RADIAL_SIDE);
  return min(last, first < 0 ? -1 : first < side ? side - 1 : 2 * side - 1);
}

// What of an area lies between two folds is one of the square's own areas, turned around.
void raise_piece(ivec2 first, ivec2 last, uint value) {
  const ivec2 a = octahedron_texel(first, int(RADIAL_SIDE));
  const ivec2 b = octahedron_texel(last, int(RADIAL_SIDE));
  const ivec2 low = min(a, b);
  const ivec2 high = max(a, b);
  for (int y = low.y; y <= high.y; ++y)
    for (int x = low.x; x <= high.x; ++x) atomicMax(s_cells[y * int(RADIAL_SIDE) + x], value);
}

void raise(RadialArea cells, uint value) {
  ivec2 last;
  for (int y = cells.low.y; y <= cells.high.y; y = last.y + 1) {
    last.y = last_before_fold(y, cells.high.y);
    for (int x = cells.low.x; x <= cells.high.x; x = last.x + 1) {
      last.x = last_before_fold(x, cells.high.x);
      raise_piece(ivec2(x, y), last, value);
    }
  }
}

// By all threads of the group together: from level to level the largest of 2 x 2 cells.
void fill_levels() {
  for (uint level = 1u; level < RADIAL_LEVELS; ++level) {
    const uint n = radial_side(level);
    const uint first = radial_first(level);
    const uint finer = radial_first(level - 1u);
    for (uint i = gl_LocalInvocationIndex; i < n * n; i += gl_WorkGroupSize.x) {
      const uint at = finer + 4u * n * (i / n) + 2u * (i % n);
      const uint below = at + 2u * n;
      s_cells[first + i] = max(max(s_cells[at], s_cells[at + 1u]), max(s_cells[below], s_cells[below + 1u]));
    }
    barrier();  // a level before the next
  }
}

#endif
