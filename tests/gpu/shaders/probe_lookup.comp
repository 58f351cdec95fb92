// Asks a probe's capture for radiance, distance and the split sum.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "probe_question.h"
#include "../../../app/render/shaders/common/probe_atlas.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer Questions { ProbeQuestion questions[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Answers { ProbeAnswer answers[]; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= questions.length()) return;
  const ProbeQuestion q = questions[i];
  answers[i].radiance = probe_radiance(q.slot, q.direction, q.roughness);
  answers[i].distance_m = probe_distance(q.slot, q.direction);
  answers[i].split = split_sum(q.n_dot_v, q.roughness);
}
