// What rounding may move a position of the world on its way to a look-up.
// Promise: the same bits in every shader that works it out.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_WORLD_SLACK
#define LAMP_COMMON_WORLD_SLACK
#include "common/frame.glsl"
#include "lamplight/shared/light.h"

float sum_of(vec3 v) {
  precise const float sum = v.x + v.y + v.z;
  return sum;
}

// Positions that look-ups are asked for come from view space through a matrix, as pixels' do: what that may move them is
// a share of their distance from the eye and from the origin.
float world_slack(Frame frame, vec3 position) {
  precise const float slack = 2.0 * ROUND_POSITION * (sum_of(abs(position)) + sum_of(abs(frame.eye_world)));
  return slack;
}

#endif
