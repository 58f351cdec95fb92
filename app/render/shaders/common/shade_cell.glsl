// The light of all lights of a pixel's cell: one loop, whatever the look-up; two without a branch where it sorts by type.
// Needs: a look-up, `frame`, `lights`.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_SHADE_CELL
#define LAMP_SHADE_CELL
#include "common/boxes.glsl"
#include "common/punctual.glsl"
#include "lookup/parts/each.glsl"

vec3 shade_mixed(Surface s, uvec2 pixel, float z_view) {
  precise vec3 sum = vec3(0.0);
  uint light;
  if (BOXES) {
    LOOKUP_EACH_IN(light, pixel, z_view, 0u, first_box(frame)) sum += shade_light(s, lights[light]);
  } else {
    LOOKUP_EACH(light, pixel, z_view) sum += shade_light(s, lights[light]);
  }
  return sum;
}

#ifdef LOOKUP_BY_TYPE
vec3 shade_cell(Surface s, uvec2 pixel, float z_view) {
  if (!walk_is_sorted(pixel, z_view)) return shade_mixed(s, pixel, z_view);
  precise vec3 sum = vec3(0.0);
  uint light;
  for (Walk walk = walk_begin_points(pixel, z_view); walk_next(walk, light);) {
    if (BOXES && light >= first_box(frame)) continue;  // boxes are culled as points
    sum += shade_point(s, lights[light]);
  }
  for (Walk walk = walk_begin_spots(pixel, z_view); walk_next(walk, light);) sum += shade_spot(s, lights[light]);
  return sum;
}
#else
vec3 shade_cell(Surface s, uvec2 pixel, float z_view) { return shade_mixed(s, pixel, z_view); }
#endif

#endif
