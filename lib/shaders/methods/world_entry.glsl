// An entry of a bucket: a light, one of the light's bricks, and the cells of it that the light reaches.
// SPDX-License-Identifier: Apache-2.0
layout(constant_id = 0) const float BRICK_RATIO = 1.0;
#include "common/world_bricks.glsl"

layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) readonly buffer LightBuffer { Light lights[]; };
layout(set = 0, binding = 2, scalar) readonly buffer SphereBuffer { LightSphere spheres[]; };

uint light_of(uint entry) { return entry >> ENTRY_BRICK_BITS; }
uint code_of(uint entry) { return entry & (1u << ENTRY_BRICK_BITS) - 1u; }

// The group's number, as groups are counted.
uint group_number() { return gl_WorkGroupID.x + WORLD_GROUPS_ACROSS * gl_WorkGroupID.y; }

// Squared distances of four cells in a row, along one axis.
vec4 squared_outside(float position, float low, float side) {
  const vec4 begin = low + side * vec4(0.0, 1.0, 2.0, 3.0);
  const vec4 outside = max(max(begin - position, position - (begin + side)), vec4(0.0));
  return outside * outside;
}

uint bits_of_row(bvec4 cells) {
  const uvec4 bits = uvec4(cells) << uvec4(0u, 1u, 2u, 3u);
  return bits.x | bits.y | bits.z | bits.w;
}

// A bit for each cell that the light's sphere reaches.
uvec2 cells_of_sphere(LightBricks b, vec3 low, float side) {
  const vec4 x = squared_outside(b.center.x, low.x, side);
  const vec4 y = squared_outside(b.center.y, low.y, side);
  const vec4 left = b.radius * b.radius - squared_outside(b.center.z, low.z, side);  // for x and y
  uvec2 cells = uvec2(0u);
  [[unroll]] for (uint row = 0u; row < 16u; ++row)
    cells[row / 8u] |= bits_of_row(lessThanEqual(x, vec4(left[row / 4u] - y[row % 4u]))) << 4u * (row % 8u);
  return cells;
}

// What rounding may move a difference of squares, as a share of them: some 16 units of a float's last place.
const float ROUND_SQUARES = 2e-6;

// A bit for each cell that a spot's cone may reach: as cone_touches_cube decides, but for all cells at once. Squares and
// products are sums of an axis's share each. The squared distance from the axis is then a difference of squares, which is
// less exact: it moves the cone by less than a hundredth of a cell.
uvec2 cells_of_cone(WorldCone cone, vec3 low, float side) {
  const vec4 centers = side * vec4(0.5, 1.5, 2.5, 3.5);
  const vec3 offset = low - cone.tip;
  const vec4 x = offset.x + centers;
  const vec4 y = offset.y + centers;
  const vec4 z = offset.z + centers;
  const float cos2 = cone.cos_angle * cone.cos_angle;
  const float shrunk = cos2 * (1.0 - ROUND_SQUARES);
  const float reach = HALF_DIAGONAL * side + cone.slack + 2.0 * ROUND_RADIUS * (sum_of(abs(offset)) + 12.0 * side);
  uvec2 cells = uvec2(0u);
  [[unroll]] for (uint row = 0u; row < 16u; ++row) {
    const float y_row = y[row % 4u];
    const float z_row = z[row / 4u];
    const vec4 along = x * cone.axis.x + (y_row * cone.axis.y + z_row * cone.axis.z);
    const vec4 beyond = reach + cone.sin_angle * along;
    const vec4 aside2 = shrunk * (x * x) + (shrunk * (y_row * y_row + z_row * z_row) - cos2 * (along * along));
    const bvec4 ahead = greaterThanEqual(along, vec4(-reach));  // of the tip, where `beyond` is not negative
    const bvec4 inside = lessThanEqual(aside2, beyond * beyond);
    cells[row / 8u] |= (bits_of_row(ahead) & bits_of_row(inside)) << 4u * (row % 8u);
  }
  return cells;
}

uvec2 cells_of(LightBricks b, uint light, uint code) {
  if (b.level == WORLD_EVERYTHING) return uvec2(~0u);
  const float side = brick_side(b.level);
  const vec3 low = side * brick_of_code(b, code);
  const uvec2 cells = cells_of_sphere(b, low, 0.25 * side);
  if (lights[light].type != LIGHT_SPOT) return cells;
  return cells & cells_of_cone(world_cone(frame, lights[light]), low, 0.25 * side);
}
