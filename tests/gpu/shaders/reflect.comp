// One thread a case: what the surface reflects of the light, and of surroundings that are alike everywhere.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "../../../app/render/shaders/common/brdf.glsl"
#include "reflect_case.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer CaseBuffer { ReflectCase cases[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer AnswerBuffer { ReflectAnswer answers[]; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= cases.length()) return;
  const ReflectCase c = cases[i];
  const Reflector r = reflector(Surface(vec3(0.0), c.normal, c.to_eye, c.base_color, c.metallic, c.roughness, 1.0));
  const float n_l = fused_dot(c.normal, c.to_light);
  const vec3 halfway = fma(c.to_light, vec3(0.5), r.half_eye);
  answers[i] = ReflectAnswer(reflect_light(r, halfway, n_l, n_l), reflect_surroundings(r, vec3(1.0)));
}
