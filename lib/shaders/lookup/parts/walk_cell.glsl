// The walk of a pixel is that of its cell.
// Needs: lookup_cell, walk_of_cell and walk_of_cell_in, all of a view.
// SPDX-License-Identifier: Apache-2.0
Walk walk_begin(uint view, uvec2 pixel, float z_view) {
  return walk_of_cell(view, lookup_cell(view, pixel, z_view));
}

#define LOOKUP_RANGED
Walk walk_begin_in(uint view, uvec2 pixel, float z_view, uint first, uint end) {
  return walk_of_cell_in(view, lookup_cell(view, pixel, z_view), first, end);
}
#include "lookup/parts/of_view.glsl"
