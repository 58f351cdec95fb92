// The calls of a look-up without a view: of LOOKUP_VIEW.
// Needs: lookup_cell, walk_begin and, with LOOKUP_RANGED, walk_begin_in, all of a view.
// SPDX-License-Identifier: Apache-2.0
uint lookup_cell(uvec2 pixel, float z_view) { return lookup_cell(LOOKUP_VIEW, pixel, z_view); }
Walk walk_begin(uvec2 pixel, float z_view) { return walk_begin(LOOKUP_VIEW, pixel, z_view); }
#ifdef LOOKUP_RANGED
Walk walk_begin_in(uvec2 pixel, float z_view, uint first, uint end) {
  return walk_begin_in(LOOKUP_VIEW, pixel, z_view, first, end);
}
#endif
