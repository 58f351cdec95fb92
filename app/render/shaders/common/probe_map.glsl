// Directions on the octahedral squares of a probe, and where the squares of its levels lie.
// Based on: octahedral maps: Praun, Hoppe, Spherical Parametrization and Remeshing, SIGGRAPH (2003).
// Promise: the same bits wherever a direction is looked up.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_PROBE_MAP
#define LAMP_PROBE_MAP
#include "../probe_atlas_data.h"
#include "common/octahedron.glsl"

// -1 .. 1 on the square. Of a direction of any length.
vec2 probe_place(vec3 direction) {
  precise const float sum = abs(direction.x) + abs(direction.y) + abs(direction.z);
  precise const vec2 p = direction.xy / sum;
  return direction.z >= 0.0 ? p : octahedron_folded(p);
}

uvec2 probe_level_origin(uint level) { return uvec2(probe_level_x(level), probe_level_y(level)); }

// A face of the cube looks along an axis: +x, -x, +y, -y, +z, -z.
vec3 face_forward(uint face) {
  const float way = (face & 1u) == 0u ? 1.0 : -1.0;
  return vec3(face < 2u ? way : 0.0, face >> 1u == 1u ? way : 0.0, face >= 4u ? way : 0.0);
}
vec3 face_up(uint face) { return face >> 1u == 1u ? vec3(0.0, 0.0, 1.0) : vec3(0.0, 1.0, 0.0); }

uint face_of(vec3 direction) {
  const vec3 size = abs(direction);
  if (size.x >= size.y && size.x >= size.z) return direction.x >= 0.0 ? 0u : 1u;
  if (size.y >= size.z) return direction.y >= 0.0 ? 2u : 3u;
  return direction.z >= 0.0 ? 4u : 5u;
}

// The pixel of all faces, one behind the other, that a direction meets.
uint face_pixel(vec3 direction) {
  const uint face = face_of(direction);
  const vec3 forward = face_forward(face);
  const vec3 up = face_up(face);
  const vec3 right = cross(forward, up);
  const vec2 place = vec2(dot(direction, right), -dot(direction, up)) / dot(direction, forward);
  const uvec2 pixel = uvec2(clamp((place * 0.5 + 0.5) * float(PROBE_SIDE), vec2(0.0), vec2(float(PROBE_SIDE) - 1.0)));
  return (face * PROBE_SIDE + pixel.y) * PROBE_SIDE + pixel.x;
}

#endif
