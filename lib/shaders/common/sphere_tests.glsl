// A sphere against the part of a tile between two depths, by the test that TEST names. All but the approximate cone
// never say no when the sphere touches.
// Based on: planes: Stewart, GPU Pro 7 (2016), 1.3.3; box: 1.4.3; cone: Primal engine, listing 5, and the exact distance to
// a cone's surface; exact: common/exact_tests.glsl.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_SPHERE_TESTS
#define LAMP_COMMON_SPHERE_TESTS
#include "common/exact_tests.glsl"
#include "common/mask_tests.glsl"
#include "common/tile_volume.glsl"
#include "common/volume_tests.glsl"

// An orthographic tile: a circle around its middle at each depth. Where lines of sight lean, the middle moves with the
// depth.
bool sphere_touches_cylinder(LightBounds sphere, TileSides sides) {
  const vec2 lean = vec2(sides.x_edges.y, sides.y_edges.y);  // metres for each metre ahead
  const vec2 middle = sides.cone.axis.xy - lean * sphere.center.z;
  return distance(sphere.center.xy, middle) <= sphere.radius * sides.cone.axis.z - sides.cone.slope;
}

// Listing 5 as printed: the cone's radius at the sphere's depth against the distance to the axis.
bool sphere_touches_cone_as_printed(LightBounds sphere, TileSides sides) {
  const TileCone cone = sides.cone;
  if (cone.slope < 0.0) return sphere_touches_cylinder(sphere, sides);
  const vec3 center = sphere.center - sides.eye;
  const vec3 rejection = center - dot(center, cone.axis) * cone.axis;
  const float radius = -center.z * cone.slope + sphere.radius;
  return dot(rejection, rejection) <= radius * radius;
}

// The signed distance to the cone's surface is that of its nearest generatrix; beyond the apex it is a lower bound.
bool sphere_touches_cone(LightBounds sphere, TileSides sides) {
  const TileCone cone = sides.cone;
  if (cone.slope < 0.0) return sphere_touches_cylinder(sphere, sides);
  if (cone.slope >= NO_CONE) return true;
  const vec3 center = sphere.center - sides.eye;
  const float along = dot(center, cone.axis);
  const vec3 rejection = center - along * cone.axis;
  const float outside = length(rejection) - along * cone.slope;
  return outside <= sphere.radius * sqrt(1.0 + cone.slope * cone.slope);
}

const bool TESTS_BOX = TEST == TEST_AABB || TEST == TEST_PLANES_AABB;

// What does not depend on the depths: once a light, however many ranges the tile has.
bool sphere_touches_tile_sides(LightBounds sphere, TileSides sides) {
  if (TEST == TEST_CONE_APPROXIMATE) return sphere_touches_cone_as_printed(sphere, sides);
  if (TEST == TEST_CONE) return sphere_touches_cone(sphere, sides);
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
  const float step = mask_step(ranges.z_near[0], ranges.z_far[0]);
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
