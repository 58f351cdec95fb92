// The cell of a pixel in a grid of tiles with one or two depth ranges each.
// Needs: LOOKUP_TILE_PX, LOOKUP_RANGES, LOOKUP_SPLITS_VIEW; `lookup_frames`, `lookup_splits`.
// SPDX-License-Identifier: Apache-2.0
uint lookup_cell(uint view, uvec2 pixel, float z_view) {
  const uvec2 tile = pixel / LOOKUP_TILE_PX;
  const uint tiles_wide = squares_across(lookup_frames[view], LOOKUP_TILE_PX).x;
  const uint index = tile.x + tiles_wide * tile.y;
  if (LOOKUP_RANGES == 1u) return index;
  return index * 2u + (z_view > lookup_splits[view * LOOKUP_SPLITS_VIEW + index] ? 1u : 0u);
}
