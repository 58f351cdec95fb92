// The shadow look-up at many points.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#define SHADOW_FIRST_BINDING 2
#define SHADOW_FIRST_CONSTANT 0
#include "shadow/shadow.glsl"
#include "shadow_case.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer CaseBuffer { ShadowCase cases[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer LitBuffer { float lit[]; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  lit[i] = shadow_of(cases[i].light, cases[i].position, cases[i].normal, cases[i].seed);
}
