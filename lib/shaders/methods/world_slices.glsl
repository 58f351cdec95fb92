// The slices of a brick that a light reaches: of the box around what it has there. 16 slices along each axis tell as much as
// many more cells would, and take fewer bits.
// Needs: frame; common/world_spots.glsl.
// SPDX-License-Identifier: Apache-2.0
struct Box {
  vec3 low;
  vec3 high;
};

// What rounding may move where a sphere is cut off, as a share of its squared radius.
const float ROUND_CUT = 1e-6;

// The box around the sphere's part in a cube from the origin.
Box part_of_sphere(vec3 center, float radius, float side) {
  const vec3 outside = max(max(-center, center - side), vec3(0.0));
  const vec3 outside2 = outside * outside;
  const float left = (1.0 + ROUND_CUT) * radius * radius - (outside2.x + outside2.y + outside2.z);
  const vec3 reach = sqrt(max(left + outside2, vec3(0.0))) + ROUND_RADIUS * side;
  return Box(center - reach, center + reach);
}

Box overlap(Box a, Box b) { return Box(max(a.low, b.low), min(a.high, b.high)); }

// How far a unit vector reaches beside each axis of the world.
vec3 beside_axes(vec3 v) { return vec3(length(v.yz), length(v.zx), length(v.xy)); }

// Around what a spot lights: its tip, and the cap of its range. Along an axis of the world the cap ends at its rim, or where
// the axis is within the cone at the range.
Box spot_box(Light light, float slack) {
  const vec3 axis = light.direction;
  const vec3 rim = light.sin_outer * beside_axes(axis);
  const vec3 middle = light.cos_outer * axis;
  const vec3 ahead = mix(max(middle + rim, vec3(0.0)), vec3(1.0), greaterThanEqual(axis, vec3(light.cos_outer)));
  const vec3 behind = mix(max(rim - middle, vec3(0.0)), vec3(1.0), greaterThanEqual(-axis, vec3(light.cos_outer)));
  return Box(light.position - (light.range * behind + slack), light.position + (light.range * ahead + slack));
}

// What a narrow cone has in a part: its discs, t metres from the tip and t tan wide. Those that touch the part are between
// two t, by two inequalities for each axis, and the part is no larger than they are.
Box part_of_discs(Box part, Light light, vec3 tip, float slack) {
  const float least_cos = 0.5;  // wider ones lean far out of their discs
  if (light.cos_outer < least_cos) return part;
  const vec3 axis = light.direction;
  const vec3 wide = (1.0 + ROUND_RADIUS) * light.sin_outer / light.cos_outer * beside_axes(axis);
  const vec3 low_side = axis - wide;  // of a disc, for each metre from the tip
  const vec3 high_side = axis + wide;
  const vec3 low = part.low - tip - slack;
  const vec3 high = part.high - tip + slack;
  float first = 0.0;
  float last = light.range;
  [[unroll]] for (uint i = 0u; i < 3u; ++i) {
    if (low_side[i] > 0.0) last = min(last, high[i] / low_side[i]);
    if (low_side[i] < 0.0) first = max(first, high[i] / low_side[i]);
    if (high_side[i] > 0.0) first = max(first, low[i] / high_side[i]);
    if (high_side[i] < 0.0) last = min(last, low[i] / high_side[i]);
  }
  last = max(last, 0.0);
  first = min(first, last);  // rounding may turn them around
  return overlap(part, Box(tip - slack + min(first * low_side, last * low_side),
                           tip + slack + max(first * high_side, last * high_side)));
}

// Bits of the slices of an axis between two places, in slices from the brick's beginning.
uvec3 slices_between(vec3 low, vec3 high) {
  const vec3 last_slice = vec3(BRICK_SLICES - 1u);
  const uvec3 first = uvec3(clamp(low, vec3(0.0), last_slice));
  const uvec3 last = max(uvec3(clamp(high, vec3(0.0), last_slice)), first);
  return (uvec3(2u) << last) - (uvec3(1u) << first);
}

// 16 bits for each axis.
uvec2 slices_of(LightBricks b, vec3 brick, Light light) {
  const float side = brick_side(b.level);
  const vec3 corner = side * brick;
  Box part = part_of_sphere(b.center - corner, b.radius, side);
  if (light.type == LIGHT_SPOT) {
    const float slack = world_slack(frame, light.position) + 2.0 * ROUND_RADIUS * (light.range + side);
    part = overlap(part, part_of_sphere(light.position - corner, light.range + slack, side));
    const Box spot = spot_box(light, slack);
    part = overlap(part, Box(max(spot.low - corner, vec3(0.0)), min(spot.high - corner, vec3(side))));
    part = part_of_discs(part, light, light.position - corner, slack);
  }
  const float slices_a_metre = float(BRICK_SLICES) * bricks_a_metre(b.level);
  const uvec3 slices = slices_between(part.low * slices_a_metre, part.high * slices_a_metre);
  return uvec2(slices.x | slices.y << BRICK_SLICES, slices.z);
}
