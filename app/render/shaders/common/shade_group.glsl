// The light of all lights of a pixel's cell, for a work group of 8 x 8 pixels. Where these all have one cell, its
// threads load a light each, all at once, into shared memory, and every pixel reads them there: a walk by each thread
// waits for every light's index and then for the light (H200, a million lights of which a pixel sees 16, 3840x2160:
// 880 us against 640).
// Needs: a look-up, `frame`; all threads of the group.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_SHADE_GROUP
#define LAMP_SHADE_GROUP
#include "common/shade_cell.glsl"

#ifdef LOOKUP_TOGETHER
const uint GROUP_LIGHTS = 64u;  // a group's threads
shared vec4 s_places[GROUP_LIGHTS];       // position, inverse_range2
shared vec4 s_intensities[GROUP_LIGHTS];  // intensity, edge
shared vec3 s_axes[GROUP_LIGHTS];
shared uint s_lights[GROUP_LIGHTS];  // their numbers, where they have shadows

void share(uint place, uint light, Emitter e) {
  s_places[place] = vec4(e.position, e.inverse_range2);
  s_intensities[place] = vec4(e.intensity, e.edge);
  if (is_spot(e)) s_axes[place] = e.axis;
  if (SHADOW_FILTER != SHADOW_OFF) s_lights[place] = light;
}

void add_shared(inout vec3 sum, Reflector r, uint place) {
  const vec4 at = s_places[place];
  Way way;
  if (!way_to(r, at.xyz, at.w, way)) return;
  Emitter e;
  e.intensity = s_intensities[place].xyz;
  e.edge = s_intensities[place].w;
  if (is_spot(e)) e.axis = s_axes[place];
  if (SHADOW_FILTER != SHADOW_OFF && !is_lit(e, r, s_lights[place])) return;
  add_light_along(sum, r, way, e, is_spot(e));
}

void add_group(inout vec3 sum, Reflector r, bool lit, uvec2 pixel, float z_view) {
  if (BOXES || !LOOKUP_TOGETHER) {
    if (lit) add_cell(sum, r, pixel, z_view);
    return;
  }
  const uint thread = gl_LocalInvocationIndex;
  uint light;
  Walk walk = walk_begin(pixel, z_view);
  uint count = walk_take(walk, GROUP_LIGHTS, thread, light);
  while (count > 0u) {
    if (thread < count) share(thread, light, emitter_at(light));
    barrier();  // all are there
    for (uint i = 0u; lit && i < count; ++i) add_shared(sum, r, i);
    if (count + 32u <= GROUP_LIGHTS) break;  // a whole word of bits would have had room: that was all
    barrier();  // all are read before others take their places
    count = walk_take(walk, GROUP_LIGHTS, thread, light);
  }
}
#else
void add_group(inout vec3 sum, Reflector r, bool lit, uvec2 pixel, float z_view) {
  if (lit) add_cell(sum, r, pixel, z_view);
}
#endif

#endif
