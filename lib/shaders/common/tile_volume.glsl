// The sides of a tile in every form that a test wants: planes, a cone, edges that move linearly with depth.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_TILE_VOLUME
#define LAMP_COMMON_TILE_VOLUME
#include "common/frame.glsl"
#include "common/projection_eye.glsl"
#include "lamplight/shared/tile.h"

struct TileSides {
  TilePlanes planes;
  TileCone cone;
  vec3 eye;      // the cone's tip
  vec4 x_edges;  // x at z metres ahead lies between x[0] + x[1] z and x[2] + x[3] z
  vec4 y_edges;
};

// An edge at ndc: solve clip.x = ndc * clip.w for x, with z = -z_view.
vec2 edge(float scale, float of_z, float offset, float w_of_z, float w_offset, float ndc) {
  return vec2(ndc * w_offset - offset, of_z - ndc * w_of_z) / scale;
}

void tile_edges(Frame frame, vec2 min_px, vec2 max_px, out vec4 x_edges, out vec4 y_edges) {
  const mat4 m = frame.clip_from_view;
  const vec2 low = min_px / vec2(frame.size_px) * 2.0 - 1.0;
  const vec2 high = max_px / vec2(frame.size_px) * 2.0 - 1.0;
  x_edges = vec4(edge(m[0][0], m[2][0], m[3][0], m[2][3], m[3][3], low.x),
                 edge(m[0][0], m[2][0], m[3][0], m[2][3], m[3][3], high.x));
  y_edges = vec4(edge(m[1][1], m[2][1], m[3][1], m[2][3], m[3][3], low.y),
                 edge(m[1][1], m[2][1], m[3][1], m[2][3], m[3][3], high.y));
  if (m[0][0] < 0.0) x_edges = x_edges.zwxy;
  if (m[1][1] < 0.0) y_edges = y_edges.zwxy;
}

// How far a point is outside each edge, times the length of the edge's normal: sqrt(1 + slope^2).
vec4 edges_outside(vec3 point, vec4 x_edges, vec4 y_edges) {
  const float z = -point.z;
  return vec4(x_edges.x + x_edges.y * z - point.x, point.x - x_edges.z - x_edges.w * z,
              y_edges.x + y_edges.y * z - point.y, point.y - y_edges.z - y_edges.w * z);
}

vec4 edge_lengths(vec4 x_edges, vec4 y_edges) {
  const vec4 slopes = vec4(x_edges.yw, y_edges.yw);
  return sqrt(1.0 + slopes * slopes);
}

// The edges of a rectangle of pixels, for a look at many spheres.
struct RectangleEdges {
  vec4 x_edges;
  vec4 y_edges;
  vec4 lengths;  // edge_lengths
};

RectangleEdges rectangle_edges(Frame frame, vec2 min_px, vec2 max_px) {
  RectangleEdges edges;
  tile_edges(frame, min_px, max_px, edges.x_edges, edges.y_edges);
  edges.lengths = edge_lengths(edges.x_edges, edges.y_edges);
  return edges;
}

// Whether a sphere reaches to the inner side of each edge. Says yes near corners that it misses.
bool inside_edges(vec3 center, float radius, RectangleEdges edges) {
  return all(lessThanEqual(edges_outside(center, edges.x_edges, edges.y_edges), radius * edges.lengths));
}

// The larger of width and height at a depth.
float tile_width(TileSides sides, float z_view) {
  const vec2 size = vec2(sides.x_edges.z - sides.x_edges.x, sides.y_edges.z - sides.y_edges.x) +
                    vec2(sides.x_edges.w - sides.x_edges.y, sides.y_edges.w - sides.y_edges.y) * z_view;
  return max(size.x, size.y);
}

TilePlanes tile_planes(Frame frame, vec2 min_px, vec2 max_px) {
  TilePlanes planes;
  side_planes(frame, min_px, max_px, planes.planes);
  return planes;
}

vec3 cone_tip(Frame frame) { return is_perspective(frame) ? projection_eye(frame) : vec3(0.0); }

// Based on: Primal engine, Light Culling with Approximate Sphere-Cone Intersection, listing 4: radius to the top left
// corner per metre of z. The exact test takes the widest corner, per metre of the axis.
const float NO_CONE = 1e6;  // the slope of a tile that is wider than any cone: a large one in a tiny, wide picture

TileCone tile_cone(Frame frame, vec2 min_px, vec2 max_px, bool as_printed) {
  const vec3 eye = cone_tip(frame);
  const float z_view = is_perspective(frame) ? 1.0 - eye.z : 0.0;
  const vec3 middle = view_position(frame, 0.5 * (min_px + max_px), z_view) - eye;
  const vec3 corners[4] =
      vec3[](view_position(frame, min_px, z_view) - eye, view_position(frame, max_px, z_view) - eye,
             view_position(frame, vec2(min_px.x, max_px.y), z_view) - eye,
             view_position(frame, vec2(max_px.x, min_px.y), z_view) - eye);
  if (!is_perspective(frame)) {
    float radius = 0.0;
    for (int i = 0; i < 4; ++i) radius = max(radius, distance(corners[i].xy, middle.xy));
    const vec2 lean = frame.clip_from_view[2].xy / vec2(frame.clip_from_view[0][0], frame.clip_from_view[1][1]);
    return TileCone(vec3(middle.xy, sqrt(1.0 + dot(lean, lean))), -radius);
  }
  const vec3 axis = normalize(middle);
  if (as_printed) return TileCone(axis, distance(middle, corners[0]));
  float slope = 0.0;
  for (int i = 0; i < 4; ++i) {
    const float along = dot(corners[i], axis);
    const bool bounded = along > 1e-3 * length(corners[i]);
    slope = max(slope, bounded ? length(corners[i] - along * axis) / along : NO_CONE);
  }
  return TileCone(axis, slope);
}

// The view-space box around the part of a tile between two depths.
struct TileBox {
  vec3 low;
  vec3 high;
};

TileBox tile_box(TileSides sides, float z_near, float z_far) {
  const vec2 at_near = vec2(1.0, z_near);
  const vec2 at_far = vec2(1.0, z_far);
  TileBox box;
  box.low = vec3(min(dot(sides.x_edges.xy, at_near), dot(sides.x_edges.xy, at_far)),
                 min(dot(sides.y_edges.xy, at_near), dot(sides.y_edges.xy, at_far)), -z_far);
  box.high = vec3(max(dot(sides.x_edges.zw, at_near), dot(sides.x_edges.zw, at_far)),
                  max(dot(sides.y_edges.zw, at_near), dot(sides.y_edges.zw, at_far)), -z_near);
  return box;
}

// A sphere around that part: through the farthest of its corners, from the middle of its axis.
vec4 tile_sphere(TileSides sides, float z_near, float z_far) {
  const vec4 low = vec4(sides.x_edges.xy, sides.y_edges.xy);
  const vec4 high = vec4(sides.x_edges.zw, sides.y_edges.zw);
  const vec4 axis = 0.5 * (low + high);
  const vec4 half_size = 0.5 * (high - low);
  const float z = 0.5 * (z_near + z_far);
  const vec2 middle = axis.xz + axis.yw * z;
  const float half_length = z_far - z;
  // The axis leans: at either end its own way from the middle adds to half the size there.
  const vec2 lean = abs(axis.yw) * half_length;
  const vec2 at_near = lean + abs(half_size.xz + half_size.yw * z_near);
  const vec2 at_far = lean + abs(half_size.xz + half_size.yw * z_far);
  const float radius2 = max(dot(at_near, at_near), dot(at_far, at_far)) + half_length * half_length;
  return vec4(middle, -z, sqrt(radius2) * 1.00001);
}

#endif
