// One thread a case: does the cone touch the cube?
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "cone_case.h"

layout(local_size_x = 64) in;
const float BRICK_RATIO = 1.0;
#include "common/world_spots.glsl"

layout(set = 0, binding = 0, scalar) readonly buffer CaseBuffer { ConeCase cases[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer AnswerBuffer { uint answers[]; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= cases.length()) return;
  const ConeCase c = cases[i];
  const float no_end = 0.0;
  const float no_slack = 0.0;
  answers[i] = uint(cone_touches_cube(WorldSpot(true, c.tip, c.axis, c.sine, c.cosine, no_end, no_slack), c.low, c.side));
}
