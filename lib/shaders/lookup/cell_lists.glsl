// Look-up: a row's lights in one span for each piece of its cell. A cell whose lights did not fit means every light, a
// piece whose lists did not fit means all of its lights.
// SPDX-License-Identifier: Apache-2.0
#include "lookup/parts/lamplight_cell.glsl"

layout(set = 0, binding = 18, scalar) readonly buffer LookupSpans { LightSpan lookup_spans[]; };
layout(set = 0, binding = 19, scalar) readonly buffer LookupPieceLists { uint lookup_piece_lists[]; };
layout(set = 0, binding = 20, scalar) readonly buffer LookupLists { uint lookup_lists[]; };

struct Walk {
  uint at;
  uint end;
  uint span;    // the next
  uint spans;   // end of the cell's
  bool coarse;  // `at` is in the lists of pieces
  bool all;     // `at` is a light
};

Walk walk_begin(uvec2 pixel, float z_view) {
  const LightCell cell = lookup_light_cell(pixel, z_view);
  if (cell.pieces == ALL_LIGHTS) return Walk(0u, lookup_frame.light_count, 0u, 0u, false, true);
  const uint first = cell.first_piece * LOOKUP_CELL_ROWS + lookup_row(pixel, z_view);
  return Walk(0u, 0u, first, first + cell.pieces * LOOKUP_CELL_ROWS, false, false);
}

bool walk_next(inout Walk walk, out uint light) {
  while (walk.at >= walk.end) {
    if (walk.span >= walk.spans) return false;
    const LightSpan span = lookup_spans[walk.span];
    walk.span += LOOKUP_CELL_ROWS;
    walk.coarse = (span.first & COARSE) != 0u;
    walk.at = span.first & ~COARSE;
    walk.end = walk.at + span.count;
  }
  light = walk.all ? walk.at : walk.coarse ? lookup_piece_lists[walk.at] : lookup_lists[walk.at];
  ++walk.at;
  return true;
}
