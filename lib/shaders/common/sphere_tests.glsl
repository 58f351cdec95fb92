// A sphere against the part of a tile between two depths, by the test that TEST names. All but the approximate cone
// never say no when the sphere touches.
// Based on: planes: Stewart, GPU Pro 7 (2016), 1.3.3; box: 1.4.3; cone: Primal engine, listing 5, and the exact distance to
// a cone's surface; exact: convex minimisation, bounded from below by strong convexity.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_SPHERE_TESTS
#define LAMP_COMMON_SPHERE_TESTS
#include "common/mask_tests.glsl"
#include "common/tile_volume.glsl"
#include "common/volume_tests.glsl"

// Listing 5 as printed: the cone's radius at the sphere's depth against the distance to the axis.
bool sphere_touches_cone_as_printed(LightBounds sphere, TileCone cone) {
  if (cone.slope < 0.0) return distance(sphere.center.xy, cone.axis.xy) <= sphere.radius - cone.slope;
  const vec3 rejection = sphere.center - dot(sphere.center, cone.axis) * cone.axis;
  const float radius = -sphere.center.z * cone.slope + sphere.radius;
  return dot(rejection, rejection) <= radius * radius;
}

// The signed distance to the cone's surface is that of its nearest generatrix; beyond the apex it is a lower bound.
bool sphere_touches_cone(LightBounds sphere, TileCone cone) {
  if (cone.slope < 0.0) return distance(sphere.center.xy, cone.axis.xy) <= sphere.radius - cone.slope;
  if (cone.slope >= NO_CONE) return true;
  const float along = dot(sphere.center, cone.axis);
  const vec3 rejection = sphere.center - along * cone.axis;
  const float outside = length(rejection) - along * cone.slope;
  return outside <= sphere.radius * sqrt(1.0 + cone.slope * cone.slope);
}

// How far x is outside the edges at a depth, and how that changes with the depth.
vec2 outside_edges(float x, vec4 edges, float z) {
  const float below = edges.x + edges.y * z - x;
  const float above = x - (edges.z + edges.w * z);
  if (below > 0.0) return vec2(below, edges.y);
  if (above > 0.0) return vec2(above, -edges.w);
  return vec2(0.0);
}

// Squared distance from a sphere's centre to a frustum's cross-section at a depth, with its first derivative along z and half
// its second. f(z) = (z - c)^2 + dx(z)^2 + dy(z)^2 is convex and piecewise quadratic, and f'' >= 2 everywhere.
struct Section {
  float value;
  float slope;
  float curve;
};

Section section_at(LightBounds sphere, TileSides sides, float z) {
  const float ahead = z + sphere.center.z;
  const vec2 dx = outside_edges(sphere.center.x, sides.x_edges, z);
  const vec2 dy = outside_edges(sphere.center.y, sides.y_edges, z);
  return Section(ahead * ahead + dx.x * dx.x + dy.x * dy.x, 2.0 * (ahead + dx.x * dx.y + dy.x * dy.y),
                 1.0 + dx.y * dx.y + dy.y * dy.y);
}

// No less than f anywhere in [z_near, z_far] can be, as f'' >= 2: a bound that cannot lose a light.
float least_in(Section section, float z, float z_near, float z_far) {
  const float down = clamp(z - 0.5 * section.slope, z_near, z_far) - z;
  return section.value + section.slope * down + down * down;
}

// Newton finds the piece that holds the minimum in a few steps.
bool sphere_touches_frustum(LightBounds sphere, TileSides sides, float z_near, float z_far) {
  const float radius2 = sphere.radius * sphere.radius;
  float z = clamp(-sphere.center.z, z_near, z_far);
  for (int i = 0; i < 4; ++i) {
    const Section section = section_at(sphere, sides, z);
    if (section.value <= radius2) return true;
    if (least_in(section, z, z_near, z_far) > radius2) return false;
    z = clamp(z - 0.5 * section.slope / section.curve, z_near, z_far);
  }
  return true;
}

// The depths that parts of a mask span, with a margin for rounding.
vec2 depths_of_parts(float z_mask, float step, uint parts) {
  return z_mask + step * vec2(float(findLSB(parts)) - 0.001, float(findMSB(parts)) + 1.001);
}

// The same for the occupied parts of a mask alone. f has one minimum, so that of what is occupied lies there, or at the
// nearest occupied depth on either side.
bool sphere_touches_parts(LightBounds sphere, TileSides sides, float z_mask, float step, uint parts) {
  if (parts == 0u) return false;
  const float radius2 = sphere.radius * sphere.radius;
  const vec2 depths = depths_of_parts(z_mask, step, parts);
  const float z_near = depths.x;
  const float z_far = depths.y;
  float z = clamp(-sphere.center.z, z_near, z_far);
  for (int i = 0; i < 3; ++i) {
    const Section section = section_at(sphere, sides, z);
    if (least_in(section, z, z_near, z_far) > radius2) return false;
    if (section.slope == 0.0) break;
    z = clamp(z - 0.5 * section.slope / section.curve, z_near, z_far);
  }
  const uint part = uint(clamp((z - z_mask) / max(step, 1e-30), 0.0, float(MASK_BITS - 1u)));
  const uint below = parts & ~0u >> (31u - part);
  const uint above = parts & ~0u << part;
  const float z_below = min(z, z_mask + step * (float(findMSB(below)) + 1.001));
  const float z_above = max(z, z_mask + step * (float(findLSB(above)) - 0.001));
  return (below != 0u && least_in(section_at(sphere, sides, z_below), z_below, z_near, z_below) <= radius2) ||
         (above != 0u && least_in(section_at(sphere, sides, z_above), z_above, z_above, z_far) <= radius2);
}

const bool TESTS_BOX = TEST == TEST_AABB || TEST == TEST_PLANES_AABB;

// What does not depend on the depths: once a light, however many ranges the tile has.
bool sphere_touches_tile_sides(LightBounds sphere, TileSides sides) {
  if (TEST == TEST_CONE_APPROXIMATE) return sphere_touches_cone_as_printed(sphere, sides.cone);
  if (TEST == TEST_CONE) return sphere_touches_cone(sphere, sides.cone);
  if (TEST == TEST_PLANES || TEST == TEST_PLANES_AABB) return sphere_touches_sides(sphere, sides.planes.planes);
  return true;
}

// What does; the box is that of the same depths.
bool sphere_touches_tile_depths(LightBounds sphere, TileSides sides, TileBox box, float z_near, float z_far) {
  if (!sphere_touches_depths(sphere, z_near, z_far)) return false;
  if (TESTS_BOX) return sphere_touches_box(sphere, box.low, box.high);
  return TEST != TEST_EXACT || sphere_touches_frustum(sphere, sides, z_near, z_far);
}

// The test, for every run of occupied parts that the sphere's depths meet.
bool sphere_touches_runs(LightBounds sphere, TileSides sides, TileRanges ranges, uint parts) {
  const float step = (ranges.z_far[0] - ranges.z_near[0]) / float(MASK_BITS);
  if (TEST == TEST_EXACT) return sphere_touches_parts(sphere, sides, ranges.z_near[0], step, parts);
  while (parts != 0u) {
    const uint first = uint(findLSB(parts));
    const uint end = first + bits_in_a_row(parts >> first);
    const float z_first = ranges.z_near[0] + step * (float(first) - 0.001);
    const float z_last = ranges.z_near[0] + step * (float(end) + 0.001);
    const TileBox box = tile_box(sides, z_first, z_last);
    if (sphere_touches_tile_depths(sphere, sides, box, z_first, z_last)) return true;
    parts &= bits_from(end);
  }
  return false;
}

#endif
