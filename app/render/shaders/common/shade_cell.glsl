// The light of all lights of a pixel's cell: one loop, whatever the look-up; two without a branch where it sorts by type.
// Needs: a look-up, `frame`.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_SHADE_CELL
#define LAMP_SHADE_CELL
#include "common/boxes.glsl"
#include "common/lights.glsl"
#include "lookup/parts/each.glsl"

void add_mixed(inout vec3 sum, Reflector r, uvec2 pixel, float z_view) {
  uint light;
  if (BOXES) {
    LOOKUP_EACH_IN(light, pixel, z_view, 0u, first_box(frame)) add_light(sum, r, light);
  } else {
    LOOKUP_EACH(light, pixel, z_view) add_light(sum, r, light);
  }
}

#ifdef LOOKUP_BY_TYPE
void add_cell(inout vec3 sum, Reflector r, uvec2 pixel, float z_view) {
  if (!walk_is_sorted(pixel, z_view)) {
    add_mixed(sum, r, pixel, z_view);
    return;
  }
  uint light;
  for (Walk walk = walk_begin_points(pixel, z_view); walk_next(walk, light);) {
    if (BOXES && light >= first_box(frame)) continue;  // boxes are culled as points
    add_light(sum, r, light, point_at(light), false);
  }
  for (Walk walk = walk_begin_spots(pixel, z_view); walk_next(walk, light);) add_light(sum, r, light, spot_at(light), true);
}
#else
void add_cell(inout vec3 sum, Reflector r, uvec2 pixel, float z_view) { add_mixed(sum, r, pixel, z_view); }
#endif

#endif
