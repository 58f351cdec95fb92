// Whether a light may bring any light to a cell: its radial bound against the part of a tile between two depths.
// Promise: never no for a cell with a point that the shadow look-up finds lit at all; the same answer in every shader.
// Needs: RADIAL_BINDING.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_RADIAL_BOUNDS
#define LAMP_COMMON_RADIAL_BOUNDS
#include "common/light_bounds.glsl"
#include "common/octahedron.glsl"
#include "common/radial_areas.glsl"
#include "common/radial_levels.glsl"

layout(set = 0, binding = RADIAL_BINDING, scalar) readonly buffer RadialBuffer { RadialBound radial_bounds[]; };

// Byte (x, y) of a level; beside an octahedron's square, that of the same direction.
uint radial_byte(uint light, uint level, ivec2 at) {
  const int n = int(radial_side(level));
  const ivec2 inside = octahedron_texel(at, n);
  const uint i = radial_first(level) + uint(n * inside.y + inside.x);
  return radial_bounds[light].bytes[i / 16u][i / 4u % 4u] >> (8u * (i % 4u)) & 255u;
}

// The largest byte of an area, or of somewhat more: 2 x 2 bytes of the finest level of which so few are enough. With a
// loop over the area a subgroup waits for the pair that is nearest to its light.
uint radial_reach(uint light, RadialArea area) {
  const int most = max(area.high.x - area.low.x, area.high.y - area.low.y);
  const uint level = most > 1 ? uint(findMSB(most - 1) + 1) : 0u;
  if (level >= RADIAL_LEVELS) return RADIAL_ANY;
  const ivec2 low = area.low >> level;
  const ivec2 high = area.high >> level;
  return max(max(radial_byte(light, level, low), radial_byte(light, level, ivec2(high.x, low.y))),
             max(radial_byte(light, level, ivec2(low.x, high.y)), radial_byte(light, level, high)));
}

// Whether the light reaches any of a sphere; around the light, of a spot in its own axes.
bool radial_reaches_sphere(uint light, vec3 center, float radius) {
  precise const float away = length(center);
  if (!(radius < RADIAL_MOST_SINE * away)) return true;
  RadialArea area;
  if (radial_bounds[light].kind == RADIAL_SPOT) {
    if (center.z + radius <= 0.0) return false;
    if (center.z - radius <= 0.0) return true;
    area = radial_area_of_spot(radial_bounds[light].scale, center, radius);
  } else {
    area = radial_area_of_sphere(center / away, radius / away);
  }
  const uint reach = radial_reach(light, area);
  precise const float least = (away - radius) / radial_bounds[light].unit_m;
  return reach == RADIAL_ANY || least <= float(reach);
}

// From view space to a light's own.
struct RadialSpace {
  mat3 axes;
  vec3 origin;
};

RadialSpace radial_space(Frame frame, uint light) {
  precise RadialSpace space;
  space.axes = mat3(frame.world_from_view);
  space.origin = frame.world_from_view[3].xyz - radial_bounds[light].position;
  if (radial_bounds[light].kind != RADIAL_SPOT) return space;
  const vec3 x = radial_bounds[light].axis_x;
  const vec3 z = radial_bounds[light].axis_z;
  const mat3 turned = transpose(mat3(x, cross(z, x), z));
  space.axes = turned * space.axes;
  space.origin = turned * space.origin;
  return space;
}

// Depths between these at which a sphere may reach anything: never infinite for a light whose bound says something.
vec2 radial_depths(LightBounds sphere, float z_near, float z_far) {
  return vec2(max(z_near, -sphere.center.z - sphere.radius), min(z_far, -sphere.center.z + sphere.radius));
}

bool radial_cuts_nothing(uint light) {
  return light >= uint(radial_bounds.length()) || radial_bounds[light].kind == RADIAL_NONE;
}

// Whether it reaches the part of a tile between its edges (TileSides) and two depths: by the sphere around that.
// Rounding: where depths do not meet, another test has said that they do, and both are held.
bool radial_reaches_part(Frame frame, uint light, vec4 x_edges, vec4 y_edges, vec2 depths) {
  if (radial_cuts_nothing(light)) return true;
  const RadialSpace space = radial_space(frame, light);
  precise const vec4 x = x_edges.xzxz + x_edges.ywyw * depths.xxyy;
  precise const vec4 y = y_edges.xzxz + y_edges.ywyw * depths.xxyy;
  precise const vec2 x_middle = 0.5 * (x.xz + x.yw);
  precise const vec2 y_middle = 0.5 * (y.xz + y.yw);
  precise const vec3 center = vec3(0.5 * (x_middle.x + x_middle.y), 0.5 * (y_middle.x + y_middle.y),
                                   -0.5 * (depths.x + depths.y));
  precise const vec3 around = 0.5 * vec3(abs(x_middle.y - x_middle.x) + max(abs(x.y - x.x), abs(x.w - x.z)),
                                         abs(y_middle.y - y_middle.x) + max(abs(y.y - y.x), abs(y.w - y.z)),
                                         abs(depths.y - depths.x));
  precise const float slack =
      4.0 * ROUND_POSITION *
      (length(radial_bounds[light].position) + length(frame.eye_world) + abs(depths.x) + abs(depths.y));
  return radial_reaches_sphere(light, space.axes * center + space.origin, length(around) + slack);
}

const uint RADIAL_MOST_PIECES = 8u;

// The same of what may be long: in pieces of an eighth of the light's range, a sphere around each.
bool radial_reaches(Frame frame, uint light, vec4 x_edges, vec4 y_edges, vec2 depths) {
  if (radial_cuts_nothing(light)) return true;
  const float length_m = abs(depths.y - depths.x);
  const float piece_m = radial_bounds[light].unit_m * float(RADIAL_ANY) / float(RADIAL_MOST_PIECES);
  const uint count = uint(clamp(ceil(length_m / piece_m), 1.0, float(RADIAL_MOST_PIECES)));
  precise const float step = (depths.y - depths.x) / float(count);
  for (uint i = 0u; i < count; ++i) {
    precise const vec2 piece = depths.x + step * vec2(float(i), float(i + 1u));
    const float last = i + 1u < count ? piece.y : depths.y;
    if (radial_reaches_part(frame, light, x_edges, y_edges, vec2(piece.x, last))) return true;
  }
  return false;
}

#endif
