// A spot in world space against a cube: its cone and the sphere of its range, each exactly. As in world_bricks.glsl, what
// decides is made of additions, multiplications and comparisons alone.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_WORLD_SPOTS
#define LAMP_COMMON_WORLD_SPOTS
#include "common/world_bricks.glsl"

struct WorldSpot {
  bool is_spot;
  vec3 tip;
  vec3 axis;
  float sine;  // of the half-angle, 90 degrees at most
  float cosine;
  float range;  // m, widened by what rounding moves
  float slack;  // m, likewise for the cone
};

// What rounding may move sums of squares, as a share of them: some 32 units of a float's last place.
const float ROUND_SQUARES = 4e-6;

WorldSpot world_spot(Frame frame, Light light) {
  const float slack = world_slack(frame, light.position);
  precise const float range = light.range * (1.0 + ROUND_RADIUS) + slack;
  return WorldSpot(light.type == LIGHT_SPOT, light.position, light.direction, light.sin_outer, light.cos_outer, range,
                   slack);
}

// A cube's middle is seen from the cone's tip. Whether the cone's axis meets it: no line across two of the coordinates parts
// them, and it lies ahead along each.
bool axis_meets(vec3 axis, vec3 middle, float half_side) {
  const vec3 lengths = abs(axis);
  precise const vec3 apart = abs(middle.yzx * axis.zxy - middle.zxy * axis.yzx);
  precise const vec3 reach = half_side * (lengths.yzx + lengths.zxy);
  precise const vec3 ahead = sign(axis) * middle + half_side;
  return all(lessThanEqual(apart, reach)) && all(greaterThanEqual(ahead, vec3(0.0)));
}

// Whether the cone meets any of the four edges along the third axis. On the line of an edge the angle to the axis is least
// where t = axis.z across2 / along, in coordinates from the tip. If that lies on the edge, the cone meets the edge where it
// meets the line; else the angle is least at an end.
bool cone_meets_edges(vec3 axis, vec3 middle, float half_side, float sine2) {
  const vec4 at_x = middle.x + half_side * vec4(-1.0, 1.0, -1.0, 1.0);
  const vec4 at_y = middle.y + half_side * vec4(-1.0, -1.0, 1.0, 1.0);
  precise const vec4 aside = at_x * axis.y - at_y * axis.x;
  precise const vec4 along = at_x * axis.x + at_y * axis.y;
  precise const vec4 across2 = at_x * at_x + at_y * at_y;
  precise const vec4 beside = abs(axis.z * across2 - middle.z * along) - half_side * along;
  precise const vec4 beyond = aside * aside - sine2 * across2;
  return any(lessThanEqual(max(beside, beyond), vec4(0.0)));
}

// The four corners at one end along z.
bool cone_meets_corners(vec3 axis, vec3 middle, float half_side, float at_z, float sine2) {
  const vec4 at_x = middle.x + half_side * vec4(-1.0, 1.0, -1.0, 1.0);
  const vec4 at_y = middle.y + half_side * vec4(-1.0, -1.0, 1.0, 1.0);
  precise const vec4 along = at_x * axis.x + at_y * axis.y + at_z * axis.z;
  precise const vec4 x = at_y * axis.z - at_z * axis.y;
  precise const vec4 y = at_z * axis.x - at_x * axis.z;
  precise const vec4 z = at_x * axis.y - at_y * axis.x;
  precise const vec4 beyond = x * x + y * y + z * z - sine2 * (at_x * at_x + at_y * at_y + at_z * at_z);
  return any(lessThanEqual(max(-along, beyond), vec4(0.0)));
}

// A convex cone meets a box where it holds the box's point of the least angle to the axis: on the axis, or on an edge.
bool cone_touches_cube(WorldSpot spot, vec3 low, float side) {
  precise const vec3 middle = low + 0.5 * side - spot.tip;
  precise const float half_side = 0.5 * side + spot.slack + 2.0 * ROUND_RADIUS * (sum_of(abs(middle)) + side);
  precise const float sine2 = spot.sine * spot.sine * (1.0 + ROUND_SQUARES);
  return axis_meets(spot.axis, middle, half_side) ||
         cone_meets_edges(spot.axis, middle, half_side, sine2) ||
         cone_meets_edges(spot.axis.yzx, middle.yzx, half_side, sine2) ||
         cone_meets_edges(spot.axis.zxy, middle.zxy, half_side, sine2) ||
         cone_meets_corners(spot.axis, middle, half_side, middle.z - half_side, sine2) ||
         cone_meets_corners(spot.axis, middle, half_side, middle.z + half_side, sine2);
}

bool spot_touches_cube(WorldSpot spot, vec3 low, float side) {
  return sphere_touches_cube(spot.tip, spot.range, low, side) && cone_touches_cube(spot, low, side);
}

#endif
