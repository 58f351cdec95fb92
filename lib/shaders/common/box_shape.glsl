// A box or an ellipsoid among the lights, as its record tells it: its axes, and how far it reaches along a vector.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_BOX_SHAPE
#define LAMP_COMMON_BOX_SHAPE
#include "common/box.glsl"
#include "common/light_bounds.glsl"

// m. Squares of larger half extents, and products with them, leave 32-bit numbers' range: the sphere has to do.
const float LARGEST_BOX = 1e9;

bool has_shape(Frame frame, uint id, Light record) {
  return id >= first_box(frame) && record.sin_outer != SHAPE_UNKNOWN && record.range < LARGEST_BOX;
}

vec3 half_extents_of(Light record) { return vec3(record.inner_angle, record.cos_outer, record.spot_scale); }

// The axes as columns, from the record's quaternion.
mat3 box_axes(Light record) {
  const vec3 q = record.direction;
  const float w = record.outer_angle;
  precise const mat3 axes =
      mat3(1.0 - 2.0 * (q.y * q.y + q.z * q.z), 2.0 * (q.x * q.y + w * q.z), 2.0 * (q.x * q.z - w * q.y),
           2.0 * (q.x * q.y - w * q.z), 1.0 - 2.0 * (q.x * q.x + q.z * q.z), 2.0 * (q.y * q.z + w * q.x),
           2.0 * (q.x * q.z + w * q.y), 2.0 * (q.y * q.z - w * q.x), 1.0 - 2.0 * (q.x * q.x + q.y * q.y));
  return axes;
}

struct ViewBox {
  vec3 center;   // view space
  mat3 to_unit;  // from an offset from there to the box or the ball of half extents 1
  vec3 squares;  // of the half extents
  float slack;   // m, of rounding: what the bounding sphere has of it
  vec3 room;     // the same in the unit box
  bool ball;
};

// `sphere`: light_bounds of the record.
ViewBox view_box(Frame frame, Light record, LightBounds sphere) {
  precise ViewBox box;
  const vec3 half_extents = half_extents_of(record);
  box.center = sphere.center;
  box.to_unit = transpose(box_axes(record)) * mat3(frame.world_from_view);
  for (int i = 0; i < 3; ++i) box.to_unit[i] /= half_extents;
  box.squares = half_extents * half_extents;
  box.slack = 4.0 * (sphere.radius - record.range);  // a view may stretch each of three half extents, both ways
  box.room = box.slack / half_extents;
  box.ball = record.sin_outer == SHAPE_ELLIPSOID;
  return box;
}

// How far the box reaches to either side of its centre, along a vector of view space, times its length.
float box_reach(ViewBox box, vec3 way) {
  precise const vec3 along = abs(box.squares * (box.to_unit * way));
  precise const float reach = box.ball ? length(along) : along.x + along.y + along.z;
  return reach;
}

#endif
