// The light of all lights of a pixel's cell, for a work group of 8 x 8 pixels. Where these all have one cell, its threads
// load a light each, all at once, into shared memory, and every pixel reads them there: a walk by each thread waits for
// every light's index and then for the light (H200, a million lights of which a pixel sees 16, 3840x2160: 880 us against
// 640).
// Needs: a look-up, `frame`; all threads of the group.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_SHADE_GROUP
#define LAMP_SHADE_GROUP
#include "common/shade_cell.glsl"

#ifdef LOOKUP_TOGETHER
const uint GROUP_LIGHTS = 64u;  // a group's threads
shared vec4 s_places[GROUP_LIGHTS];       // position, inverse_range2
shared vec4 s_intensities[GROUP_LIGHTS];  // intensity, spot_scale
shared vec4 s_cones[GROUP_LIGHTS];        // direction, cos_outer

void share(uint place, Emitter e) {
  s_places[place] = vec4(e.position, e.inverse_range2);
  s_intensities[place] = vec4(e.intensity, e.spot_scale);
  if (is_spot(e)) s_cones[place] = vec4(e.direction, e.cos_outer);
}

void add_shared(inout vec3 sum, Reflector r, uint place) {
  Emitter e;
  e.position = s_places[place].xyz;
  e.inverse_range2 = s_places[place].w;
  e.intensity = s_intensities[place].xyz;
  e.spot_scale = s_intensities[place].w;
  if (is_spot(e)) {
    e.direction = s_cones[place].xyz;
    e.cos_outer = s_cones[place].w;
  }
  add_light(sum, r, e, is_spot(e));
}

void add_group(inout vec3 sum, Reflector r, bool lit, uvec2 pixel, float z_view) {
  if (BOXES || !LOOKUP_TOGETHER) {
    if (lit) add_cell(sum, r, pixel, z_view);
    return;
  }
  const uint thread = gl_LocalInvocationIndex;
  uint light;
  uint count;
  Walk walk = walk_begin(pixel, z_view);
  while ((count = walk_take(walk, GROUP_LIGHTS, thread, light)) > 0u) {
    if (thread < count) share(thread, emitter_at(light));
    barrier();  // all are there
    for (uint i = 0u; lit && i < count; ++i) add_shared(sum, r, i);
    barrier();  // and read before others take their places
  }
}
#else
void add_group(inout vec3 sum, Reflector r, bool lit, uvec2 pixel, float z_view) {
  if (lit) add_cell(sum, r, pixel, z_view);
}
#endif

#endif
