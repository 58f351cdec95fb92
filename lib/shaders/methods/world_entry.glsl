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

// Cells of a brick are taken by layers of 16 along z, each of four rows along y.
const vec4 CELLS = vec4(0.0, 1.0, 2.0, 3.0);

// Squared distances of four cells in a row, along one axis.
vec4 squared_outside(float position, float low, float side) {
  const vec4 begin = low + side * CELLS;
  const vec4 outside = max(max(begin - position, position - (begin + side)), vec4(0.0));
  return outside * outside;
}

uint bits_of_row(bvec4 cells, uint row) {
  const uvec4 bits = mix(uvec4(0u), uvec4(1u, 2u, 4u, 8u) << 4u * row, cells);
  return bits.x | bits.y | bits.z | bits.w;
}

struct SphereCells {
  vec4 x;  // squared distances of cells along an axis
  vec4 y;
  vec4 left;  // of the radius squared, for x and y
};

SphereCells sphere_cells(vec3 center, float radius, vec3 low, float side) {
  return SphereCells(squared_outside(center.x, low.x, side), squared_outside(center.y, low.y, side),
                     radius * radius - squared_outside(center.z, low.z, side));
}

// A bit for each cell of a layer that the light's sphere reaches.
uint layer_of_sphere(SphereCells sphere, float left) {
  uint cells = 0u;
  [[unroll]] for (uint row = 0u; row < 4u; ++row)
    cells |= bits_of_row(lessThanEqual(sphere.x, vec4(left - sphere.y[row])), row);
  return cells;
}

const float HALF_DIAGONAL = 0.86602545;  // of a cube with a side of 1

// A spot's cone against the spheres around all cells at once: their distance to its nearest generatrix is at most their
// reach where cos aside <= reach + sin along, and they are not behind its tip. Squared, and as cos2 + sin2 is 1, that is
// cos2 distance2 - reach2 <= along (along + 2 sin reach), and what is squared and multiplied are sums of an axis's share
// each. Based on: Wronski, Cull That Cone! (2017).
struct ConeCells {
  float reach;
  float twice;  // 2 sin reach
  vec3 step;    // along the axis, from cell to cell
  float along;  // of the first cell
  vec4 x;       // cos2 x2, and so on
  vec4 y;
  vec4 z;
};

ConeCells cone_cells(WorldSpot cone, vec3 low, float side) {
  const vec3 offset = low - cone.tip;
  const vec3 first = offset + 0.5 * side;
  const float cos2 = cone.cosine * cone.cosine - ROUND_SQUARES;
  const vec4 x = first.x + side * CELLS;
  const vec4 y = first.y + side * CELLS;
  const vec4 z = first.z + side * CELLS;
  ConeCells c;
  c.reach = HALF_DIAGONAL * side + cone.slack + 2.0 * ROUND_RADIUS * (sum_of(abs(offset)) + 12.0 * side);
  c.twice = 2.0 * cone.sine * c.reach;
  c.step = side * cone.axis;
  c.along = dot(first, cone.axis);
  c.x = cos2 * (x * x);
  c.y = cos2 * (y * y);
  c.z = cos2 * (z * z) - c.reach * c.reach * (1.0 + ROUND_SQUARES);
  return c;
}

// A bit for each cell of a layer that the cone may reach.
uint layer_of_cone(ConeCells cone, float along_layer, float z) {
  uint cells = 0u;
  [[unroll]] for (uint row = 0u; row < 4u; ++row) {
    const vec4 along = cone.step.x * CELLS + (along_layer + cone.step.y * float(row));
    const bvec4 ahead = greaterThanEqual(along, vec4(-cone.reach));  // of the tip: behind it is the cone's other half
    const bvec4 inside = lessThanEqual(cone.x, along * (along + cone.twice) - (cone.y[row] + z));
    cells |= bits_of_row(mix(bvec4(false), inside, ahead), row);
  }
  return cells;
}

uvec2 cells_of(uint entry) {
  const uint light = light_of_entry(entry);
  const uint code = code_of_entry(entry);
  const LightBricks b = bricks_of(frame, spheres[light]);
  if (b.level == WORLD_EVERYTHING) return uvec2(~0u);
  if (HALVES == SLICE_HALVES) return slices_of(b, lights[light], code);
  const float side = 0.25 * brick_side(b.level);
  const vec3 low = 4.0 * side * brick_of_code(b, code);
  const WorldSpot spot = world_spot(frame, lights[light]);
  const SphereCells sphere = sphere_cells(b.center, b.radius, low, side);
  const SphereCells in_range = sphere_cells(spot.tip, spot.range, low, side);
  const ConeCells cone = cone_cells(spot, low, side);
  uvec2 cells = uvec2(0u);
  [[dont_unroll]] for (uint layer = 0u; layer < 4u; ++layer) {
    uint of_layer = layer_of_sphere(sphere, sphere.left[layer]);
    if (spot.is_spot)
      of_layer &= layer_of_cone(cone, cone.along + cone.step.z * float(layer), cone.z[layer]) &
                  layer_of_sphere(in_range, in_range.left[layer]);
    cells |= (layer < 2u ? uvec2(of_layer, 0u) : uvec2(0u, of_layer)) << 16u * (layer % 2u);
  }
  return cells;
}
