// A box or an ellipsoid among the lights, by the shape that its record tells: against the part of a tile between two
// depths, and against a pixel.
// Based on: slabs: Kay, Kajiya, Ray Tracing Complex Scenes, SIGGRAPH (1986), with a ray as wide as the tile; sides as
// separating planes: Gottschalk, Lin, Manocha, OBBTree, SIGGRAPH (1996).
// Promise: never no for a cell with a point in the box; the same answer in every shader.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_BOX_TESTS
#define LAMP_COMMON_BOX_TESTS
#include "common/box_shape.glsl"
#include "common/light_bounds.glsl"
#include "common/tile_volume.glsl"

// Whether it reaches to the inner side of each of the tile's edges.
bool box_inside_edges(ViewBox box, vec4 x_edges, vec4 y_edges) {
  const vec4 outside = edges_outside(box.center, x_edges, y_edges);
  precise const vec4 reach =
      vec4(box_reach(box, vec3(1.0, 0.0, x_edges.y)), box_reach(box, vec3(1.0, 0.0, x_edges.w)),
           box_reach(box, vec3(0.0, 1.0, y_edges.y)), box_reach(box, vec3(0.0, 1.0, y_edges.w)));
  return all(lessThanEqual(outside, reach + box.slack * edge_lengths(x_edges, y_edges)));
}

// Narrows a range of s to where a + b s <= 0.
void narrow_where(inout vec2 range, float a, float b) {
  precise const float end = -a / b;
  if (b > 0.0) range.y = min(range.y, end);
  if (b < 0.0) range.x = max(range.x, end);
  if (b == 0.0 && a > 0.0) range.y = -INFINITE_RADIUS;
}

// The tile's rectangle s metres behind the box's centre, in the unit box: its middle, and how far it reaches to either
// side of that along x and y of view space. All of them are linear in s.
struct UnitRay {
  vec3 middle;
  vec3 middle_step;  // a metre
  vec2 half_size;    // m
  vec2 half_step;    // m a metre
};

UnitRay unit_ray(ViewBox box, vec4 x_edges, vec4 y_edges) {
  precise UnitRay ray;
  const float z = -box.center.z;
  const vec2 x = x_edges.xz + x_edges.yw * z;
  const vec2 y = y_edges.xz + y_edges.yw * z;
  const vec2 middle_step = 0.5 * vec2(x_edges.y + x_edges.w, y_edges.y + y_edges.w);
  ray.middle = box.to_unit * vec3(0.5 * (x.x + x.y) - box.center.x, 0.5 * (y.x + y.y) - box.center.y, 0.0);
  ray.middle_step = box.to_unit * vec3(middle_step, -1.0);
  ray.half_size = 0.5 * vec2(x.y - x.x, y.y - y.x);
  ray.half_step = 0.5 * vec2(x_edges.w - x_edges.y, y_edges.w - y_edges.y);
  return ray;
}

// Where the rectangle's own box, along the axes of the unit box, meets that.
void narrow_to_slabs(inout vec2 range, ViewBox box, UnitRay ray) {
  precise const vec3 around = abs(box.to_unit[0]) * ray.half_size.x + abs(box.to_unit[1]) * ray.half_size.y;
  precise const vec3 step = abs(box.to_unit[0]) * ray.half_step.x + abs(box.to_unit[1]) * ray.half_step.y;
  for (int i = 0; i < 3; ++i) {
    precise const float reach = 1.0 + box.room[i] + around[i];
    narrow_where(range, ray.middle[i] - reach, ray.middle_step[i] - step[i]);
    narrow_where(range, -ray.middle[i] - reach, -ray.middle_step[i] - step[i]);
  }
}

// Where the circle around the rectangle meets the unit ball.
void narrow_to_ball(inout vec2 range, ViewBox box, UnitRay ray) {
  precise float around = 0.0;
  for (int i = 0; i < 2; ++i) {
    precise const vec2 half_size = ray.half_size + ray.half_step * range[i];
    precise const vec3 x = box.to_unit[0] * half_size.x;
    precise const vec3 y = box.to_unit[1] * half_size.y;
    around = max(around, max(length(x + y), length(x - y)));
  }
  precise const float reach = 1.0 + max(box.room.x, max(box.room.y, box.room.z)) + around;
  precise const float square = dot(ray.middle_step, ray.middle_step);
  precise const float nearest = -dot(ray.middle, ray.middle_step) / square;
  precise const vec3 at = ray.middle + ray.middle_step * nearest;
  precise const float rest = reach * reach - dot(at, at);
  precise const float half_length = sqrt(max(rest, 0.0) / square) + box.slack;
  range = vec2(max(range.x, nearest - half_length), min(range.y, nearest + half_length));
  if (rest < 0.0) range.y = -INFINITE_RADIUS;
}

// Of the depths between two, those at which a box may reach into a tile with these edges; x > y: none. For a light, or a
// box whose shape is not known, all of them. `sphere`: light_bounds of the record, which the depths' own test has passed.
vec2 box_depths(Frame frame, uint id, Light record, LightBounds sphere, vec4 x_edges, vec4 y_edges, vec2 depths) {
  if (!has_shape(frame, id, record)) return depths;
  const ViewBox box = view_box(frame, record, sphere);
  if (!box_inside_edges(box, x_edges, y_edges)) return vec2(0.0, -INFINITE_RADIUS);
  precise const float reach = box_reach(box, vec3(0.0, 0.0, 1.0)) + box.slack;
  precise vec2 range = depths + box.center.z;
  range = vec2(max(range.x - box.slack, -reach), min(range.y + box.slack, reach));
  const UnitRay ray = unit_ray(box, x_edges, y_edges);
  narrow_to_slabs(range, box, ray);
  if (box.ball && range.x <= range.y) narrow_to_ball(range, box, ray);
  precise const vec2 found = range - box.center.z;
  return range.x <= range.y ? found + box.slack * vec2(-1.0, 1.0) : vec2(0.0, -INFINITE_RADIUS);
}

bool box_reaches(Frame frame, uint id, Light record, LightBounds sphere, vec4 x_edges, vec4 y_edges, vec2 depths) {
  const vec2 found = box_depths(frame, id, record, sphere, x_edges, y_edges, depths);
  return found.x <= found.y;
}

// Depths that it spans: of a box less than its sphere does.
vec2 depth_span(Frame frame, uint id, Light record, LightBounds sphere) {
  float reach = sphere.radius;
  if (has_shape(frame, id, record)) {
    const ViewBox box = view_box(frame, record, sphere);
    reach = min(reach, box_reach(box, vec3(0.0, 0.0, 1.0)) + box.slack);
  }
  return -sphere.center.z + vec2(-reach, reach);
}

// Whether a position of the world may lie in it, which is known to `slack` metres.
bool box_may_hold(Frame frame, uint id, Light record, vec3 position, float slack) {
  if (!has_shape(frame, id, record)) return true;
  const vec3 half_extents = half_extents_of(record);
  const vec3 local = (position - record.position) * box_axes(record);
  if (record.sin_outer == SHAPE_BOX) return all(lessThanEqual(abs(local), half_extents + slack));
  const float least = min(half_extents.x, min(half_extents.y, half_extents.z));
  return length(local / half_extents) <= 1.0 + slack / least;
}

#endif
