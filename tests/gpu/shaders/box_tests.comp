// One thread a case: the box's record against the tile and the position.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/box_tests.glsl"
#include "common/volume_tests.glsl"
#include "box_case.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frames[]; };
layout(set = 0, binding = 1, scalar) readonly buffer CaseBuffer { BoxCase cases[]; };
layout(set = 0, binding = 2, scalar) readonly buffer RecordBuffer { Light records[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer AnswerBuffer { BoxAnswer answers[]; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= cases.length()) return;
  const BoxCase c = cases[i];
  const Frame frame = frames[c.tile.frame];
  const Light record = records[i];
  const LightBounds sphere = light_bounds(frame, record);
  const vec2 depths = vec2(z_view_of(frame, c.tile.nearest), z_view_of(frame, c.tile.farthest));
  vec4 x_edges;
  vec4 y_edges;
  tile_edges(frame, c.tile.min_px, c.tile.max_px, x_edges, y_edges);
  vec4 planes[4];
  side_planes(frame, c.tile.min_px, c.tile.max_px, planes);
  const float slack = ROUND_RADIUS * record.range + ROUND_POSITION * (length(record.position) + length(c.position));
  BoxAnswer answer;
  answer.depths = box_depths(frame, 0u, record, sphere, x_edges, y_edges, depths);
  answer.span = depth_span(frame, 0u, record, sphere);
  answer.slack = slack;
  answer.sphere_touches = uint(sphere_touches_sides(sphere, planes) && sphere_touches_depths(sphere, depths.x, depths.y));
  answer.may_hold = uint(box_may_hold(frame, 0u, record, c.position, slack));
  answers[i] = answer;
}
