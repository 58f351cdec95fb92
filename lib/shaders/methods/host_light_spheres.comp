// One thread a light, as the host keeps it: its bounding sphere in world space, as light_spheres has it of records.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "common/host_lights.glsl"

layout(local_size_x_id = 0) in;
layout(set = 0, binding = 2, scalar) writeonly buffer SphereBuffer { LightSphere spheres[]; };

void main() {
  const uint light = gl_GlobalInvocationID.x;
  if (light < light_count_of(frame)) spheres[light] = light_sphere(host_light(light));
}
