// One thread a case: all probes in their order, and the first one's direction.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "../../../app/render/shaders/common/probe_blend.glsl"
#include "probe_case.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer ProbeBuffer { ProbeData probes[]; };
layout(set = 0, binding = 1, scalar) readonly buffer CaseBuffer { ProbeCase cases[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer AnswerBuffer { ProbeBlendAnswer answers[]; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= cases.length()) return;
  const ProbeCase c = cases[i];
  ProbeSum sum = ProbeSum(vec3(0.0), 0.0);
  for (uint k = 0u; k < probes.length(); ++k) {
    const float weight = probe_volume_weight(probes[k], c.position);
    if (weight > 0.0) add_probe_light(sum, weight, probes[k].flat_radiance);
  }
  answers[i] = ProbeBlendAnswer(sum.specular, sum.weight, probe_direction(probes[0], c.position, c.direction),
                                probe_seen(c.distance_m, c.nearest_m));
}
