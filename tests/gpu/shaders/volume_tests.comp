// One thread a case: the light's bounds, and every volume test against the tile.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/light_bounds.glsl"
#include "common/volume_tests.glsl"
#include "volume_case.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frames[]; };
layout(set = 0, binding = 1, scalar) readonly buffer CaseBuffer { VolumeCase cases[]; };
layout(set = 0, binding = 2, scalar) readonly buffer LightBuffer { Light lights[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer AnswerBuffer { VolumeAnswer answers[]; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= cases.length()) return;
  const VolumeCase c = cases[i];
  const Frame frame = frames[c.frame];
  const LightBounds bounds = light_bounds(frame, lights[i]);
  const float z_near = z_view_of(frame, c.nearest);
  const float z_far = z_view_of(frame, c.farthest);

  vec4 planes[4];
  side_planes(frame, c.min_px, c.max_px, planes);
  vec3 box_min = vec3(3e38);
  vec3 box_max = vec3(-3e38);
  for (uint corner = 0u; corner < 8u; ++corner) {
    const vec2 pixel = vec2((corner & 1u) == 0u ? c.min_px.x : c.max_px.x, (corner & 2u) == 0u ? c.min_px.y : c.max_px.y);
    const vec3 p = view_position(frame, pixel, (corner & 4u) == 0u ? z_near : z_far);
    box_min = min(box_min, p);
    box_max = max(box_max, p);
  }

  uint touches = 0u;
  if (sphere_touches_sides(bounds, planes)) touches |= TOUCHES_SIDES;
  if (sphere_touches_depths(bounds, z_near, z_far)) touches |= TOUCHES_DEPTHS;
  if (sphere_touches_box(bounds, box_min, box_max)) touches |= TOUCHES_BOX;
  answers[i] = VolumeAnswer(bounds, touches);
}
