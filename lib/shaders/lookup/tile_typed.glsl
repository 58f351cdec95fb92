// Look-up: one shared list; a tile has an offset, a count of points and a count of spots, which stand behind the points.
// A tile that did not fit walks every light. Shading may walk points and spots in two loops without a branch.
// Based on: Primal engine, Light Culling with Approximate Sphere-Cone Intersection, listing 9.
// SPDX-License-Identifier: Apache-2.0
#include "common/frame.glsl"
#define LOOKUP_BY_TYPE
#define LOOKUP_TOGETHER (LOOKUP_RANGES == 1u)

layout(constant_id = 100) const uint LOOKUP_TILE_PX = 32;
layout(constant_id = 101) const uint LOOKUP_RANGES = 1;
layout(set = 0, binding = 16, scalar) readonly buffer LookupFrame { Frame lookup_frame; };
layout(set = 0, binding = 17, scalar) readonly buffer LookupLists { uint lookup_lists[]; };
layout(set = 0, binding = 18, scalar) readonly buffer LookupSplits { float lookup_splits[]; };
layout(set = 0, binding = 19, scalar) readonly buffer LookupHeaders { uvec2 lookup_headers[]; };

#include "lookup/parts/tile_cell.glsl"

const uint LOOKUP_OVERFLOWED = ~0u;

struct Walk {
  uint at;
  uint end;
  bool overflowed;
};

void lookup_prepare() {}

// Both kinds, points first.
Walk walk_begin(uvec2 pixel, float z_view) {
  const uvec2 header = lookup_headers[lookup_cell(pixel, z_view)];
  if (header.x == LOOKUP_OVERFLOWED) return Walk(0u, light_count_of(lookup_frame), true);
  return Walk(header.x, header.x + (header.y & 0xffffu) + (header.y >> 16), false);
}

// Whether the list's kinds can be told by their place; a cell that did not fit holds both, mixed.
bool walk_is_sorted(uvec2 pixel, float z_view) {
  return lookup_headers[lookup_cell(pixel, z_view)].x != LOOKUP_OVERFLOWED;
}

Walk walk_begin_points(uvec2 pixel, float z_view) {
  const uvec2 header = lookup_headers[lookup_cell(pixel, z_view)];
  return Walk(header.x, header.x + (header.y & 0xffffu), false);
}

Walk walk_begin_spots(uvec2 pixel, float z_view) {
  const uvec2 header = lookup_headers[lookup_cell(pixel, z_view)];
  const uint first = header.x + (header.y & 0xffffu);
  return Walk(first, first + (header.y >> 16), false);
}

uint lookup_light_at(Walk walk, uint place) { return walk.overflowed ? place : lookup_lists[place]; }

#include "lookup/parts/walk_places.glsl"
