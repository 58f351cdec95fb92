// Clusters, each a range of one shared list; a range beyond its end means every light.
// SPDX-License-Identifier: Apache-2.0
#include "lookup/parts/cluster_cell.glsl"

layout(constant_id = 105) const uint LOOKUP_ENTRIES = 1;
layout(set = 0, binding = 17, scalar) readonly buffer LookupRanges { uvec2 lookup_ranges[]; };
layout(set = 0, binding = 18, scalar) readonly buffer LookupLists { uint lookup_lists[]; };

struct Walk {
  uint at;
  uint end;
  bool overflowed;
};

Walk walk_of_cell(uint cell) {
  const uvec2 range = lookup_ranges[cell];
  if (range.x > LOOKUP_ENTRIES || range.y > LOOKUP_ENTRIES - range.x) return Walk(0u, lookup_frame.light_count, true);
  return Walk(range.x, range.x + range.y, false);
}

Walk walk_begin(uvec2 pixel, float z_view) { return walk_of_cell(lookup_cell(pixel, z_view)); }

bool walk_next(inout Walk walk, out uint light) {
  if (walk.at >= walk.end) return false;
  light = walk.overflowed ? walk.at : lookup_lists[walk.at];
  ++walk.at;
  return true;
}
