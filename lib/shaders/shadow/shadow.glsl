// The shadow look-up: how much of a light's light arrives at a point, from the maps of a ShadowAtlas. The filter is a
// specialization constant.
// Promise: 0 in full shadow (of vsm and evsm: where less than their bleeding is left), 1 where nothing is drawn before the point, 1 for a light without a map; the same bits in
// every shader for the same arguments.
// SPDX-License-Identifier: Apache-2.0
#ifndef SHADOW_LOOKUP
#define SHADOW_LOOKUP
#include "shadow/parts/moments.glsl"
#include "shadow/parts/offset.glsl"
#include "shadow/parts/taps.glsl"

vec3 shadow_moved(vec3 rel, vec3 normal, float offset) {
  precise const vec3 moved = vec3(LAMP_FMA(normal.x, offset, rel.x), LAMP_FMA(normal.y, offset, rel.y),
                                  LAMP_FMA(normal.z, offset, rel.z));
  return moved;
}

// Where a point is looked up: moved along its normal, so that its surface casts no shadow on itself. Its w is not > 0 where
// the light's map does not show it. Moved across a seam it is another face or octant that shows it, perhaps at a flatter
// angle: then the offset must be enough for that one.
ShadowPlace shadow_moved_place(uint light, vec3 position, vec3 normal) {
  precise const vec3 rel = position - shadow_maps[light].position;
  const ShadowPlace place = shadow_place(light, rel);
  if (!(place.w > 0.0)) return place;
  float taps = 0.0;
  if (SHADOW_FILTER == SHADOW_PCF) taps = shadow_pcf_radius(light);
  // Of a blur the middle counts: on a plane its taps are as much before as behind.
  if (SHADOW_FILTER == SHADOW_VSM || SHADOW_FILTER == SHADOW_EVSM) taps = 1.0;
  const float offset = shadow_normal_offset(light, place.axis, place.w, rel, normal, taps);
  const ShadowPlace there = shadow_place(light, shadow_moved(rel, normal, offset));
  if (shadow_dot(there.axis, place.axis) > 0.5) return there;  // the same one: of others it is 1/3 at most
  const float across = shadow_dot(there.axis, rel) * shadow_fold(light);  // 1 / an axis's part
  if (!(across > 0.0)) return there;
  const float further = shadow_normal_offset(light, there.axis, across, rel, normal, taps);
  return shadow_place(light, shadow_moved(rel, normal, max(offset, further)));
}

// `light`: its index among the frame's. `position`: world, m. `normal`: unit, on the side that is lit. `seed` turns the
// taps of pcf: a number of the pixel in pictures, a hash of the position elsewhere.
float shadow_of(uint light, vec3 position, vec3 normal, uint seed) {
  if (shadow_maps[light].kind == SHADOW_NONE) return 1.0;
  const ShadowPlace place = shadow_moved_place(light, position, normal);
  if (!(place.w > 0.0)) return 1.0;
  if (SHADOW_FILTER == SHADOW_PCF) return shadow_pcf(light, place, seed);
  if (SHADOW_FILTER == SHADOW_VSM) return shadow_vsm(light, place);
  if (SHADOW_FILTER == SHADOW_EVSM) return shadow_evsm(light, place);
  return shadow_hard(light, place);
}

#endif
