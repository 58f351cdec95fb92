// What single reflection probes weigh at a point. A thread a probe.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lamplight/shared/frame.h"
#include "lamplight/shared/light.h"
#include "common/probe_weight.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 2, std430) readonly buffer IdBuffer { uint ids[]; };
layout(set = 0, binding = 3, scalar) readonly buffer LightBuffer { Light lights[]; };
layout(set = 0, binding = 8, scalar) writeonly buffer WeightBuffer { vec2 weights[]; };
layout(push_constant, scalar) uniform Push {
  vec3 position;  // world, m
  uint count;
};

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  const ProbeData probe = probes[ids[i]];
  weights[i] = vec2(probe_volume_weight(probe, position), probe_weight(probe, position));
}
