// Look-up: every light.
// SPDX-License-Identifier: Apache-2.0
#include "common/frame.glsl"

layout(set = 0, binding = 16, scalar) readonly buffer LookupFrame { Frame lookup_frame; };

struct Walk {
  uint at;
  uint end;
};

#define LOOKUP_TOGETHER true
void lookup_prepare() {}

uint lookup_cell(uvec2 pixel, float z_view) { return 0u; }

Walk walk_begin(uvec2 pixel, float z_view) { return Walk(0u, light_count_of(lookup_frame)); }

#define LOOKUP_RANGED
Walk walk_begin_in(uvec2 pixel, float z_view, uint first, uint end) {
  return Walk(first, min(end, light_count_of(lookup_frame)));
}

uint lookup_light_at(Walk walk, uint place) { return place; }

#include "lookup/parts/walk_places.glsl"
