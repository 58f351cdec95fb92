// Look-up: a row's lights in one span for each piece of its cell. A cell whose lights did not fit means every light, a
// piece whose lists did not fit means all of its lights.
// SPDX-License-Identifier: Apache-2.0
#include "lookup/parts/lamplight_cell.glsl"
#define LOOKUP_TOGETHER (LOOKUP_SLICES == 1u)

LOOKUP_BUFFER(2, LookupSpans, LightSpan, lookup_spans);
LOOKUP_BUFFER(3, LookupPieceLists, uint, lookup_piece_lists);
LOOKUP_BUFFER(4, LookupLists, uint, lookup_lists);
LOOKUP_VIEW_WORDS(2, LOOKUP_SPANS_VIEW);
LOOKUP_VIEW_WORDS(3, LOOKUP_PIECE_LISTS_VIEW);
LOOKUP_VIEW_WORDS(4, LOOKUP_LISTS_VIEW);

struct Walk {
  uint at;     // with COARSE: in the lists of pieces
  uint end;
  uint span;   // the next
  uint spans;  // end of the cell's
  bool all;    // `at` is a light
  uint view;
};

Walk walk_of_all() {
  Walk walk;
  walk.at = 0u;
  walk.end = lookup_light_count();
  walk.span = 0u;
  walk.spans = 0u;
  walk.all = true;
  walk.view = 0u;
  return walk;
}

// `count` entries from `first` on, then the spans of `pieces` pieces from `span` on.
Walk walk_spans(uint view, uint first, uint count, uint span, uint pieces) {
  Walk walk;
  walk.at = first;
  walk.end = first + count;
  walk.span = span;
  walk.spans = span + pieces * lookup_cell_rows(view);
  walk.all = false;
  walk.view = view;
  return walk;
}

LightSpan lookup_span_at(uint view, uint index) { return lookup_spans[view * (LOOKUP_SPANS_VIEW / 2u) + index]; }

Walk walk_begin(uint view, uvec2 pixel, float z_view) {
  const uint index = lookup_light_cell(view, pixel, z_view);
  const LightCell cell = lookup_cell_at(view, index);
  if (cell.pieces == ALL_LIGHTS) return walk_of_all();
  const uint row = lookup_row(view, pixel, z_view);
  const uint next = cell.first_piece * lookup_cell_rows(view) + row;
  if (LOOKUP_FIRST_AT_CELL == 0u) return walk_spans(view, 0u, 0u, next, cell.pieces);
  const LightSpan span = lookup_span_at(view, index * lookup_cell_rows(view) + row);  // of a cell without lights anything
  return walk_spans(view, span.first, cell.pieces == 0u ? 0u : span.count, next, max(cell.pieces, 1u) - 1u);
}
#include "lookup/parts/of_view.glsl"

void lookup_next_span(inout Walk walk) {
  const LightSpan span = lookup_span_at(walk.view, walk.span);
  walk.span += lookup_cell_rows(walk.view);
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
  if ((place & COARSE) != 0u) return lookup_piece_lists[walk.view * LOOKUP_PIECE_LISTS_VIEW + (place & ~COARSE)];
  return lookup_lists[walk.view * LOOKUP_LISTS_VIEW + place];
}

bool walk_next(inout Walk walk, out uint light) {
  light = 0u;
  if (!walk_span(walk)) return false;
  light = lookup_light_at(walk, walk.at);
  ++walk.at;
  return true;
}

uint walk_take(inout Walk walk, uint most, uint rank, out uint light) {
  uint taken = 0u;
  light = 0u;
  while (taken < most) {
    if (!walk_span(walk)) break;
    const uint count = min(walk.end - walk.at, most - taken);
    if (rank - taken < count) light = lookup_light_at(walk, walk.at + rank - taken);
    taken += count;
    walk.at += count;
  }
  return taken;
}
