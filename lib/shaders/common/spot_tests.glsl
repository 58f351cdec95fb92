// A spot light's cone against the part of a tile between two depths, by the test that SPOT names. Never no when it touches.
// Based on: planes: Primal engine's base (cone against six planes); sphere: the distance from a sphere's centre to a
// cone's surface, as in Wronski, Cull That Cone! (2017).
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_SPOT_TESTS
#define LAMP_COMMON_SPOT_TESTS
#include "common/light_bounds.glsl"
#include "common/tile_ranges.glsl"
#include "common/tile_volume.glsl"

// View space: as the view shows a cone of the world. Where the view is not rigid the axis is not quite unit, and what
// was a cone around it lies in one that is wider by a share of `stretch`.
struct SpotCone {
  vec3 tip;
  vec3 axis;
  float range;
  float sin_angle;
  float cos_angle;
  float slack;    // m: rounding, as in light_bounds
  float stretch;  // the frame's
};

const float ANY_RANGE = 3e38;  // m

SpotCone spot_cone(Frame frame, Light light) {
  SpotCone cone;
  cone.tip = (frame.view_from_world * vec4(light.position, 1.0)).xyz;
  cone.axis = mat3(frame.view_from_world) * light.direction;
  cone.range = light.range < INFINITE_RADIUS ? light.range : ANY_RANGE;
  cone.cos_angle = light.cos_outer;
  cone.sin_angle = light.sin_outer;
  cone.slack = ROUND_POSITION * (length(cone.tip) + length(light.position) + length(frame.eye_world));
  cone.stretch = frame.stretch;
  return cone;
}

// The sphere's distance to the generatrix nearest to it, to the cap and to the plane through the tip. What the view
// stretches moves a point of the cone by a share of its distance from the tip, and each of these distances by two more
// of the centre's. A tip may be so far away that rounding alone is more than any scene.
bool cone_touches_sphere(SpotCone cone, vec4 sphere) {
  const vec3 offset = sphere.xyz - cone.tip;
  const float distance2 = dot(offset, offset);
  const float along = dot(offset, cone.axis);
  const float rejection = length(offset - along * cone.axis);  // not a difference of squares: narrow cones need it exact
  const float reach = sphere.w + cone.slack +
                      (ROUND_RADIUS + 3.0 * cone.stretch) * (sqrt(distance2) + min(cone.range, sqrt(distance2)));
  return !(reach < INFINITE_RADIUS) ||
         (cone.cos_angle * rejection - cone.sin_angle * along <= reach && along >= -reach &&
          distance2 <= (cone.range + reach) * (cone.range + reach));
}

// Discs around the axis, t metres from the tip and t tan wide, hold all that the cone reaches. A disc that touches the frustum
// is nowhere farther outside a plane than it is wide: one inequality in t for each plane. For narrow cones, whose discs
// hardly lean out of their planes.
bool discs_touch_frustum(SpotCone cone, TileSides sides, float z_near, float z_far) {
  const float z = -cone.tip.z;
  const float ahead = -cone.axis.z;
  const vec4 lengths = edge_lengths(sides.x_edges, sides.y_edges);
  const vec4 toward = vec4(sides.x_edges.y * ahead - cone.axis.x, cone.axis.x - sides.x_edges.w * ahead,
                           sides.y_edges.y * ahead - cone.axis.y, cone.axis.y - sides.y_edges.w * ahead);
  const float slope = cone.sin_angle / cone.cos_angle * (1.0 + ROUND_RADIUS + cone.stretch);
  const float slack = cone.slack + ROUND_RADIUS * cone.range;
  // a + b t <= 0
  const vec4 a_sides = edges_outside(cone.tip, sides.x_edges, sides.y_edges) - slack * lengths;
  const vec4 b_sides = toward - slope * lengths;
  const float a[6] = float[](a_sides.x, a_sides.y, a_sides.z, a_sides.w, z_near - z - slack, z - z_far - slack);
  const float b[6] = float[](b_sides.x, b_sides.y, b_sides.z, b_sides.w, -ahead - slope, ahead - slope);
  float first = 0.0;
  float last = cone.range;
  for (int i = 0; i < 6; ++i) {
    if (b[i] > 0.0)
      last = min(last, -a[i] / b[i]);
    else if (b[i] < 0.0)
      first = max(first, -a[i] / b[i]);
    else if (a[i] > 0.0)
      return false;
  }
  return first <= last + 1e-5 * (first + abs(last));
}

// A cone with a flat base that encloses the spot; wide ones have no such base within reason, and always pass.
bool cone_touches_planes(SpotCone cone, TileSides sides, float z_near, float z_far) {
  const float widest = 0.5;  // cosine of 60 degrees
  if (cone.cos_angle < widest || cone.range >= INFINITE_RADIUS) return true;
  const float base_radius = cone.range * cone.sin_angle / cone.cos_angle;
  const float slack = cone.slack + ROUND_RADIUS * (cone.range + base_radius);
  for (int i = 0; i < 6; ++i) {
    const vec4 plane = i < 4    ? sides.planes.planes[i]
                       : i == 4 ? vec4(0.0, 0.0, -1.0, -z_near)
                                : vec4(0.0, 0.0, 1.0, z_far);
    const float at_tip = dot(plane.xyz, cone.tip) + plane.w;
    const float toward = dot(plane.xyz, cone.axis);
    const float aside = sqrt(max(1.0 + 3.0 * cone.stretch - toward * toward, 0.0));
    const float at_base = at_tip + toward * cone.range + base_radius * aside;
    if (max(at_tip, at_base) < -slack) return false;
  }
  return true;
}

// Against the spheres around the occupied parts of the mask, of which neighbours are taken together while they are not
// longer than the tile is wide: a sphere around fewer of them would hardly be smaller. None reaches across a border, a
// bit at the part behind it.
bool cone_touches_parts(SpotCone cone, TileSides sides, float z_near, float z_far, uint parts, uint borders) {
  const float step = mask_step(z_near, z_far);
  while (parts != 0u) {
    const uint first = uint(findLSB(parts));
    const float z_first = z_near + step * (float(first) - 0.001);
    const float most = clamp(tile_width(sides, z_first) / step, 1.0, float(MASK_BITS));
    const uint to_border = uint(findLSB(borders >> first & ~1u));  // without one the largest number there is
    const uint end = first + min(to_border, min(uint(most), bits_in_a_row(parts >> first)));
    if (cone_touches_sphere(cone, tile_sphere(sides, z_first, z_near + step * (float(end) + 0.001)))) return true;
    parts &= bits_from(end);
  }
  return false;
}

bool spot_touches_tile(Frame frame, Light light, TileSides sides, float z_near, float z_far, uint parts, uint borders) {
  const SpotCone cone = spot_cone(frame, light);
  if (SPOT == SPOT_CONE_PLANES) return cone_touches_planes(cone, sides, z_near, z_far);
  if (!cone_touches_sphere(cone, tile_sphere(sides, z_near, z_far))) return false;
  return SPOT != SPOT_CONE_SEGMENTS || cone_touches_parts(cone, sides, z_near, z_far, parts, borders);
}

bool spot_touches_tile(Frame frame, Light light, TileSides sides, float z_near, float z_far, uint parts) {
  return spot_touches_tile(frame, light, sides, z_near, z_far, parts, 0u);
}

#endif
