// What one reflection probe says at a surface: its weight, and in which direction of its capture the reflection lies.
// Based on: Lagarde, Zanuttini, Local Image-Based Lighting with Parallax-Corrected Cubemaps, SIGGRAPH talks (2012).
// Promise: the same bits in every shader; weights of a surface never sum to more than 1.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_PROBE_BLEND
#define LAMP_PROBE_BLEND
#include "common/box.glsl"
#include "../probe_data.h"

const float NO_WAY = 1e-12;  // of a direction along an axis: it never meets that axis's walls

// 0 outside the volume, 1 from `blend` metres inside it on. In an ellipsoid the distance to its surface is taken as
// that of the unit sphere which it is scaled to, times its shortest half axis: never more than it is.
float probe_volume_weight(ProbeData p, vec3 position) {
  const vec3 local = box_local(p.volume, position);
  const vec3 half_extents = p.volume.half_extents;
  precise const vec3 rest = half_extents - abs(local);
  precise float inside = min(rest.x, min(rest.y, rest.z));
  if (p.ellipsoid != 0u) {
    precise const vec3 scaled = local / half_extents;
    precise const float squared = scaled.x * scaled.x + (scaled.y * scaled.y + scaled.z * scaled.z);
    precise const float share = 1.0 - sqrt(squared);
    inside = share * min(half_extents.x, min(half_extents.y, half_extents.z));
  }
  if (!(inside > 0.0)) return 0.0;
  precise const float weight = p.blend > 0.0 ? min(inside / p.blend, 1.0) : 1.0;
  return weight;
}

// How far along a direction the walls of a box are, seen from inside it.
float way_to_box(vec3 local, vec3 direction, vec3 half_extents) {
  precise const vec3 way = (half_extents * sign(direction) - local) / direction;
  const vec3 far = mix(way, vec3(1e30), lessThan(abs(direction), vec3(NO_WAY)));
  return min(far.x, min(far.y, far.z));
}

float way_to_ellipsoid(vec3 local, vec3 direction, vec3 half_extents) {
  precise const vec3 from = local / half_extents;
  precise const vec3 along = direction / half_extents;
  precise const float a = dot(along, along);
  precise const float b = dot(from, along);
  precise const float c = dot(from, from) - 1.0;
  precise const float way = (sqrt(max(b * b - a * c, 0.0)) - b) / a;
  return way;
}

// Where the reflection meets the parallax volume, as a unit direction from the place of the capture. A surface outside
// that volume sees the direction as it is.
vec3 probe_direction(ProbeData p, vec3 position, vec3 direction) {
  const OrientedBox walls = OrientedBox(p.parallax_center, p.volume.axis_x, p.volume.axis_y, p.volume.axis_z,
                                        p.parallax_half_extents);
  const vec3 local = box_local(walls, position);
  precise const vec3 along = vec3(dot(direction, walls.axis_x), dot(direction, walls.axis_y), dot(direction, walls.axis_z));
  precise const vec3 scaled = local / walls.half_extents;
  const bool inside = p.ellipsoid != 0u ? dot(scaled, scaled) <= 1.0 : all(lessThanEqual(abs(local), walls.half_extents));
  if (!inside) return direction;
  const float way = p.ellipsoid != 0u ? way_to_ellipsoid(local, along, walls.half_extents)
                                      : way_to_box(local, along, walls.half_extents);
  precise const vec3 seen = position + direction * way - p.capture;
  return dot(seen, seen) > 0.0 ? normalize(seen) : direction;
}

// Where a capture saw nearer surfaces than this one, there is a wall between. Its distances are those of texels: up to
// WALL_SLACK farther (m, and of the distance) the surface counts as seen, and from there the weight falls to 0 over
// WALL_FADE times that.
const float WALL_SLACK = 0.06;
const float WALL_FADE = 2.0;

float probe_seen(float distance_m, float nearest_m) {
  precise const float slack = WALL_SLACK * (1.0 + nearest_m);
  precise const float seen = clamp(1.0 - (distance_m - nearest_m - slack) / (WALL_FADE * slack), 0.0, 1.0);
  return seen;
}

// What all probes give a surface so far.
struct ProbeSum {
  vec3 specular;  // radiance towards the eye
  float weight;   // 0 .. 1; the surroundings have the rest
};

// Takes of a weight what is left. `reflected`: radiance towards the eye.
void add_probe_light(inout ProbeSum sum, float weight, vec3 reflected) {
  precise const float left = 1.0 - sum.weight;
  precise const float more = sum.weight + weight;
  precise const vec3 specular = fma(vec3(min(weight, left)), reflected, sum.specular);
  sum.specular = specular;
  sum.weight = weight < left ? min(more, 1.0) : 1.0;
}

#endif
