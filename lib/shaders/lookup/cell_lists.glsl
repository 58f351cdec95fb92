// Look-up: a row's lights in one span for each piece of its cell. A cell whose lights did not fit means every light, a
// piece whose lists did not fit means all of its lights.
// SPDX-License-Identifier: Apache-2.0
#include "lookup/parts/lamplight_cell.glsl"
#define LOOKUP_TOGETHER (LOOKUP_SLICES == 1u)

layout(set = 0, binding = 18, scalar) readonly buffer LookupSpans { LightSpan lookup_spans[]; };
layout(set = 0, binding = 19, scalar) readonly buffer LookupPieceLists { uint lookup_piece_lists[]; };
layout(set = 0, binding = 20, scalar) readonly buffer LookupLists { uint lookup_lists[]; };

struct Walk {
  uint at;     // with COARSE: in the lists of pieces
  uint end;
  uint span;   // the next
  uint spans;  // end of the cell's
  bool all;    // `at` is a light
};

Walk walk_begin(uvec2 pixel, float z_view) {
  const uint index = lookup_light_cell(pixel, z_view);
  const LightCell cell = lookup_cells[index];
  if (cell.pieces == ALL_LIGHTS) return Walk(0u, light_count_of(lookup_frame), 0u, 0u, true);
  const uint row = lookup_row(pixel, z_view);
  const uint next = cell.first_piece * LOOKUP_CELL_ROWS + row;
  if (LOOKUP_FIRST_AT_CELL == 0u) return Walk(0u, 0u, next, next + cell.pieces * LOOKUP_CELL_ROWS, false);
  const LightSpan span = lookup_spans[index * LOOKUP_CELL_ROWS + row];  // of a cell without lights anything
  const uint further = max(cell.pieces, 1u) - 1u;
  const uint count = cell.pieces == 0u ? 0u : span.count;
  return Walk(span.first, span.first + count, next, next + further * LOOKUP_CELL_ROWS, false);
}

void lookup_next_span(inout Walk walk) {
  const LightSpan span = lookup_spans[walk.span];
  walk.span += LOOKUP_CELL_ROWS;
  walk.at = span.first;
  walk.end = span.first + span.count;
}

// The next span with lights left; false if there is none.
bool walk_span(inout Walk walk) {
  while (walk.at >= walk.end) {
    if (walk.span >= walk.spans) return false;
    lookup_next_span(walk);
  }
  return true;
}

uint lookup_light_at(Walk walk, uint place) {
  if (walk.all) return place;
  return (place & COARSE) != 0u ? lookup_piece_lists[place & ~COARSE] : lookup_lists[place];
}

bool walk_next(inout Walk walk, out uint light) {
  if (!walk_span(walk)) return false;
  light = lookup_light_at(walk, walk.at);
  ++walk.at;
  return true;
}

uint walk_take(inout Walk walk, uint most, uint rank, out uint light) {
  uint taken = 0u;
  light = 0u;
  while (taken < most && walk_span(walk)) {
    const uint count = min(walk.end - walk.at, most - taken);
    if (rank - taken < count) light = lookup_light_at(walk, walk.at + rank - taken);
    taken += count;
    walk.at += count;
  }
  return taken;
}
