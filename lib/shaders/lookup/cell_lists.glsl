// Look-up: a tile's lights in one span for each piece of its cell. A cell whose lights did not fit means every light, a
// piece whose lists did not fit means all of its lights.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/shared/frame.h"
#include "lamplight/shared/lamplight.h"

layout(constant_id = 100) const uint LOOKUP_TILE_PX = 16;
layout(constant_id = 101) const uint LOOKUP_CELL_TILES = 4;
layout(set = 0, binding = 16, scalar) readonly buffer LookupFrame { Frame lookup_frame; };
layout(set = 0, binding = 17, scalar) readonly buffer LookupCells { LightCell lookup_cells[]; };
layout(set = 0, binding = 18, scalar) readonly buffer LookupSpans { LightSpan lookup_spans[]; };
layout(set = 0, binding = 19, scalar) readonly buffer LookupLists { uint lookup_lists[]; };
layout(set = 0, binding = 20, scalar) readonly buffer LookupPieceLists { uint lookup_piece_lists[]; };

struct Walk {
  uint at;
  uint end;
  uint span;    // the next
  uint spans;   // end of the cell's
  bool coarse;  // `at` is in the lists of pieces
  bool all;     // `at` is a light
};

void lookup_prepare() {}

uint lookup_cell(uvec2 pixel, float z_view) {
  const uvec2 tile = pixel / LOOKUP_TILE_PX;
  return tile.x + (lookup_frame.size_px.x + LOOKUP_TILE_PX - 1u) / LOOKUP_TILE_PX * tile.y;
}

Walk walk_begin(uvec2 pixel, float z_view) {
  const uint cell_px = LOOKUP_TILE_PX * LOOKUP_CELL_TILES;
  const uvec2 at = pixel / cell_px;
  const LightCell cell = lookup_cells[at.x + (lookup_frame.size_px.x + cell_px - 1u) / cell_px * at.y];
  if (cell.pieces == ALL_LIGHTS) return Walk(0u, lookup_frame.light_count, 0u, 0u, false, true);
  const uint tiles = LOOKUP_CELL_TILES * LOOKUP_CELL_TILES;
  const uvec2 tile = pixel / LOOKUP_TILE_PX % LOOKUP_CELL_TILES;
  const uint first = cell.first_piece * tiles + tile.x + LOOKUP_CELL_TILES * tile.y;
  return Walk(0u, 0u, first, first + cell.pieces * tiles, false, false);
}

bool walk_next(inout Walk walk, out uint light) {
  while (walk.at >= walk.end) {
    if (walk.span >= walk.spans) return false;
    const LightSpan span = lookup_spans[walk.span];
    walk.span += LOOKUP_CELL_TILES * LOOKUP_CELL_TILES;
    walk.coarse = (span.first & COARSE) != 0u;
    walk.at = span.first & ~COARSE;
    walk.end = walk.at + span.count;
  }
  light = walk.all ? walk.at : walk.coarse ? lookup_piece_lists[walk.at] : lookup_lists[walk.at];
  ++walk.at;
  return true;
}
