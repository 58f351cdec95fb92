// A spot in world space against cubes: the sphere of its range, exactly, and its cone against the sphere around a cube. As
// in world_bricks.glsl, what decides is made of additions, multiplications and comparisons alone.
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
const float HALF_DIAGONAL = 0.86602545;  // of a cube with a side of 1

WorldSpot world_spot(Frame frame, Light light) {
  const float slack = world_slack(frame, light.position);
  precise const float range = light.range * (1.0 + ROUND_RADIUS) + slack;
  return WorldSpot(light.type == LIGHT_SPOT, light.position, light.direction, light.sin_outer, light.cos_outer, range,
                   slack);
}

// What a cone needs to be held against spheres of one radius R. A sphere's centre is `aside` from the axis, `along` it and
// `distance` from the tip. The sphere touches the cone's side where cos aside <= R + sin along, and the tip where
// distance <= R. As cos2 + sin2 is 1, both are cos2 (distance2 - R2) <= max(along + sin R, 0)2.
// Based on: Wronski, Cull That Cone! (2017).
struct ConeReach {
  float cos2;
  float around;  // m2, cos2 R2
  float ahead;   // m, sin R
};

// For spheres around cubes of that side, whose coordinates from the tip add up to `farthest` at most.
ConeReach cone_reach(WorldSpot spot, float side, float farthest) {
  precise const float radius = (HALF_DIAGONAL * side + spot.slack + 2.0 * ROUND_RADIUS * farthest) * (1.0 + ROUND_SQUARES);
  precise ConeReach reach;
  reach.cos2 = max(spot.cosine * spot.cosine - ROUND_SQUARES, 0.0);
  reach.around = reach.cos2 * (radius * radius);
  reach.ahead = spot.sine * radius;
  return reach;
}

bool cone_touches_cube(WorldSpot spot, vec3 low, float side) {
  precise const vec3 middle = low + 0.5 * side - spot.tip;
  const ConeReach reach = cone_reach(spot, side, sum_of(abs(middle)) + side);
  precise const float along = middle.x * spot.axis.x + middle.y * spot.axis.y + middle.z * spot.axis.z;
  precise const float ahead = max(along + reach.ahead, 0.0);
  precise const float beyond = reach.cos2 * square_of(middle) - reach.around - ahead * ahead;
  return beyond < 0.0;
}

bool spot_touches_cube(WorldSpot spot, vec3 low, float side) {
  return sphere_touches_cube(spot.tip, spot.range, low, side) && cone_touches_cube(spot, low, side);
}

#endif
