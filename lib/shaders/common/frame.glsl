// How many lights there are; from pixels and device depth to positions, and the planes of a tile, for every projection of
// view.h.
// Based on: planes straight from the matrix: Gribb, Hartmann, Fast Extraction of Viewing Frustum Planes (2001).
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_FRAME
#define LAMP_COMMON_FRAME
#include "common/language.glsl"
#include "lamplight/shared/frame.h"

// Lights of the frame. Whatever was counted, there are no more than there is room for: nothing is indexed beyond.
uint light_count_of(Frame frame) { return min(frame.light_count, frame.light_capacity); }

bool is_sky(Frame frame, float device_depth) { return device_depth == (frame.sky_bits == 0u ? 0.0 : 1.0); }

// Squares across and down the picture, the partial ones included, and how many there are.
uvec2 squares_across(Frame frame, uint side_px) { return (frame.size_px + side_px - 1u) / side_px; }
uint square_count(Frame frame, uint side_px) {
  const uvec2 across = squares_across(frame, side_px);
  return across.x * across.y;
}

// Metres ahead of the eye of a device depth that is not the sky's: clip.z = A z + B and clip.w = C z + D, solved for -z.
float z_view_of(Frame frame, float device_depth) {
  const mat4 m = frame.clip_from_view;
  precise const float z = (m[3][3] * device_depth - m[3][2]) / (m[2][2] - m[2][3] * device_depth);
  return -z;
}

// View-space position z_view metres ahead at a pixel (continuous: centres at +0.5).
vec3 view_position(Frame frame, vec2 pixel, float z_view) {
  const mat4 m = frame.clip_from_view;
  precise const float z = -z_view;
  precise const float w = m[2][3] * z + m[3][3];
  precise const vec2 ndc = pixel / vec2(frame.size_px) * 2.0 - 1.0;
  precise const vec2 xy = (ndc * w - m[2].xy * z - m[3].xy) / vec2(m[0][0], m[1][1]);
  return vec3(xy, z);
}

vec3 world_position(Frame frame, vec2 pixel, float z_view) {
  const vec3 p = view_position(frame, pixel, z_view);
  const mat4 m = frame.world_from_view;
  precise const vec3 world =
      LAMP_FMA(m[0].xyz, p.xxx, LAMP_FMA(m[1].xyz, p.yyy, LAMP_FMA(m[2].xyz, p.zzz, m[3].xyz)));
  return world;
}

vec4 clip_row(Frame frame, int row) {
  const mat4 m = frame.clip_from_view;
  return vec4(m[0][row], m[1][row], m[2][row], m[3][row]);
}

vec4 unit_plane(vec4 plane) { return plane / length(plane.xyz); }

// The four side planes (left, right, top, bottom) of a rectangle of pixels, positive inside. View space, unit normals.
void side_planes(Frame frame, vec2 min_px, vec2 max_px, out vec4 planes[4]) {
  const vec2 low = min_px / vec2(frame.size_px) * 2.0 - 1.0;
  const vec2 high = max_px / vec2(frame.size_px) * 2.0 - 1.0;
  const vec4 x = clip_row(frame, 0);
  const vec4 y = clip_row(frame, 1);
  const vec4 w = clip_row(frame, 3);
  planes[0] = unit_plane(x - low.x * w);
  planes[1] = unit_plane(high.x * w - x);
  planes[2] = unit_plane(y - low.y * w);
  planes[3] = unit_plane(high.y * w - y);
}

#endif
