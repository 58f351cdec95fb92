// Look-up: one shared list; a tile has an offset, a count of points and a count of spots, which stand behind the points.
// A tile that did not fit walks every light. Shading may walk points and spots in two loops without a branch.
// Based on: Primal engine, Light Culling with Approximate Sphere-Cone Intersection, listing 9.
// SPDX-License-Identifier: Apache-2.0
#include "lookup/parts/resources.glsl"
#define LOOKUP_BY_TYPE
#define LOOKUP_TOGETHER (LOOKUP_RANGES == 1u)

LOOKUP_CONSTANT(0, uint, LOOKUP_TILE_PX, 32);
LOOKUP_CONSTANT(1, uint, LOOKUP_RANGES, 1);
LOOKUP_BUFFER(1, LookupLists, uint, lookup_lists);
LOOKUP_BUFFER(2, LookupSplits, float, lookup_splits);
LOOKUP_BUFFER(3, LookupHeaders, uvec2, lookup_headers);
LOOKUP_VIEW_WORDS(1, LOOKUP_LISTS_VIEW);
LOOKUP_VIEW_WORDS(2, LOOKUP_SPLITS_VIEW);
LOOKUP_VIEW_WORDS(3, LOOKUP_HEADERS_VIEW);

#include "lookup/parts/list_walk.glsl"
#include "lookup/parts/tile_cell.glsl"

LAMP_CONST LOOKUP_OVERFLOWED = ~0u;

void lookup_prepare() {}

// Where the list begins, its points and its spots.
uvec3 lookup_header(uint view, uvec2 pixel, float z_view) {
  const uvec2 header = lookup_headers[view * (LOOKUP_HEADERS_VIEW / 2u) + lookup_cell(view, pixel, z_view)];
  const uint first = header.x == LOOKUP_OVERFLOWED ? header.x : view * LOOKUP_LISTS_VIEW + header.x;
  return uvec3(first, header.y & 0xffffu, header.y >> 16);
}

// Both kinds, points first.
Walk walk_begin(uint view, uvec2 pixel, float z_view) {
  const uvec3 header = lookup_header(view, pixel, z_view);
  if (header.x == LOOKUP_OVERFLOWED) return walk_from(0u, lookup_light_count(), true);
  return walk_from(header.x, header.x + header.y + header.z, false);
}
#include "lookup/parts/of_view.glsl"

// Whether the list's kinds can be told by their place; a cell that did not fit holds both, mixed.
bool walk_is_sorted(uvec2 pixel, float z_view) {
  return lookup_header(LOOKUP_VIEW, pixel, z_view).x != LOOKUP_OVERFLOWED;
}

Walk walk_begin_points(uvec2 pixel, float z_view) {
  const uvec3 header = lookup_header(LOOKUP_VIEW, pixel, z_view);
  return walk_from(header.x, header.x + header.y, false);
}

Walk walk_begin_spots(uvec2 pixel, float z_view) {
  const uvec3 header = lookup_header(LOOKUP_VIEW, pixel, z_view);
  const uint first = header.x + header.y;
  return walk_from(first, first + header.z, false);
}

uint lookup_light_at(Walk walk, uint place) {
  if (walk.overflowed) return place;
  return lookup_lists[place];
}

#include "lookup/parts/walk_places.glsl"
