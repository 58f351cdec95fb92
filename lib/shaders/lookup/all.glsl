// Look-up: every light.
// SPDX-License-Identifier: Apache-2.0
#include "lookup/parts/resources.glsl"


struct Walk {
  uint at;
  uint end;
};

#define LOOKUP_TOGETHER true
void lookup_prepare() {}

uint lookup_cell(uint view, uvec2 pixel, float z_view) { return 0u; }

#define LOOKUP_RANGED
Walk walk_begin_in(uint view, uvec2 pixel, float z_view, uint first, uint end) {
  Walk walk;
  walk.at = first;
  walk.end = min(end, lookup_light_count());
  return walk;
}

Walk walk_begin(uint view, uvec2 pixel, float z_view) {
  return walk_begin_in(view, pixel, z_view, 0u, lookup_light_count());
}
#include "lookup/parts/of_view.glsl"

uint lookup_light_at(Walk walk, uint place) { return place; }

#include "lookup/parts/walk_places.glsl"
