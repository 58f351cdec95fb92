// One thread a light: its bounding sphere in world space, where nobody else keeps them.
// Based on: Stewart, GPU Pro 7 (2016), 1.4.1: culling data in a buffer of its own.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/light_bounds.glsl"

layout(local_size_x_id = 0) in;
layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) readonly buffer LightBuffer { Light lights[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer SphereBuffer { LightSphere spheres[]; };

void main() {
  const uint light = gl_GlobalInvocationID.x;
  if (light < light_count_of(frame)) spheres[light] = light_sphere(lights[light]);
}
