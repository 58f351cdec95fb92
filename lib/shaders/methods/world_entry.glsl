// An entry of a bucket: a light, one of the light's bricks, and the cells of it that the light reaches, or its slices.
// Needs: HALVES, CELL_HALVES or SLICE_HALVES.
// SPDX-License-Identifier: Apache-2.0
layout(constant_id = 0) const float BRICK_RATIO = 1.0;
#include "common/world_spots.glsl"

layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) readonly buffer LightBuffer { Light lights[]; };
layout(set = 0, binding = 2, scalar) readonly buffer SphereBuffer { LightSphere spheres[]; };

// The group's number, as groups are counted.
uint group_number() { return gl_WorkGroupID.x + WORLD_GROUPS_ACROSS * gl_WorkGroupID.y; }

#include "methods/world_slices.glsl"

// Cells of a brick are taken in rows along x, four in a layer, of which there are four along z.
const vec4 CELLS = vec4(0.0, 1.0, 2.0, 3.0);

// Bits go in at the lower end, so that the first that went in is the highest: one where a value is below 0.
uint push_signs(uint bits, vec4 values) {
  const uvec4 signs = floatBitsToUint(values) >> 31u;
  bits = bits << 1u | signs.w;
  bits = bits << 1u | signs.z;
  bits = bits << 1u | signs.y;
  return bits << 1u | signs.x;
}

// Squared distances of cells that begin there, along one axis.
vec4 squared_outside(float position, vec4 begin, float side) {
  const vec4 outside = max(max(begin - position, position - (begin + side)), vec4(0.0));
  return outside * outside;
}

uvec2 with_layer(uvec2 cells, uint layer, uint bits) {
  return cells | (layer < 2u ? uvec2(bits, 0u) : uvec2(0u, bits)) << 16u * (layer % 2u);
}

// Cells of a brick that a sphere touches; its centre is seen from the brick's corner.
uvec2 cells_of_sphere(vec3 center, float radius, float side) {
  const vec4 x = squared_outside(center.x, side * CELLS, side);
  const vec4 y = squared_outside(center.y, side * CELLS, side);
  uvec2 cells = uvec2(0u);
  [[dont_unroll]] for (uint layer = 0u; layer < 4u; ++layer) {
    const float z = squared_outside(center.z, vec4(side * float(layer)), side).x - radius * radius;
    uint bits = 0u;
    [[unroll]] for (int row = 3; row >= 0; --row) bits = push_signs(bits, x + (y[row] + z));
    cells = with_layer(cells, layer, bits);
  }
  return cells;
}

// Cells whose spheres around them a cone touches (ConeReach): sums of an axis's share each. The brick's corner is seen from
// the cone's tip.
uvec2 cells_of_cone(WorldSpot spot, vec3 corner, float side) {
  const ConeReach reach = cone_reach(spot, side, sum_of(abs(corner)) + 12.0 * side);
  const vec3 first = corner + 0.5 * side;
  const vec3 step = side * spot.axis;
  const float first_ahead = dot(first, spot.axis) + reach.ahead;
  const vec4 x = first.x + side * CELLS;
  const vec4 y = first.y + side * CELLS;
  const vec4 x_share = reach.cos2 * (x * x);
  const vec4 y_share = reach.cos2 * (y * y);
  uvec2 cells = uvec2(0u);
  [[dont_unroll]] for (uint layer = 0u; layer < 4u; ++layer) {
    const float z = first.z + side * float(layer);
    const float z_share = reach.cos2 * (z * z) - reach.around;
    uint bits = 0u;
    [[unroll]] for (int row = 3; row >= 0; --row) {
      const float row_ahead = first_ahead + (step.z * float(layer) + step.y * float(row));
      const vec4 ahead = max(row_ahead + step.x * CELLS, vec4(0.0));
      bits = push_signs(bits, x_share + (y_share[row] + z_share) - ahead * ahead);
    }
    cells = with_layer(cells, layer, bits);
  }
  return cells;
}

// Of one of the light's bricks. A spot is its range's sphere and its cone; others are their sphere.
uvec2 cells_of(LightBricks b, vec3 brick, Light light) {
  if (b.level == WORLD_EVERYTHING) return uvec2(~0u);
  if (HALVES == SLICE_HALVES) return slices_of(b, brick, light);
  const float side = 0.25 * brick_side(b.level);
  const vec3 corner = 4.0 * side * brick;
  const WorldSpot spot = world_spot(frame, light);
  // Seen from the corner, a tiny light's place is rounded by more than its radius.
  const float radius = (spot.is_spot ? spot.range : b.radius) + 4.0 * ROUND_RADIUS * side;
  const uvec2 cells = cells_of_sphere((spot.is_spot ? spot.tip : b.center) - corner, radius, side);
  return spot.is_spot ? cells & cells_of_cone(spot, corner - spot.tip, side) : cells;
}

uvec2 cells_of_entry(uint entry) {
  const LightBricks b = bricks_of(frame, spheres[light_of_entry(entry)]);
  return cells_of(b, brick_of_code(b, code_of_entry(entry)), lights[light_of_entry(entry)]);
}
