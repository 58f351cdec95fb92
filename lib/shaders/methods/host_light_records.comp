// One thread a light, as the host keeps it: the record that passes read, of a point light that is
// no box only the half that they read.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "common/host_lights.glsl"

layout(local_size_x_id = 0) in;
layout(set = 0, binding = 2, std430) writeonly buffer RecordBuffer { uvec4 records[]; };  // Light, four for each

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= light_count_of(frame)) return;
  const Light light = host_light(i);
  records[4u * i] = floatBitsToUint(vec4(light.position, light.range));
  records[4u * i + 1u] = uvec4(0u, 0u, 0u, light.type);
  if (light.type != LIGHT_SPOT && i < first_box(frame)) return;  // of boxes without a shape, that there is none
  records[4u * i + 2u] = floatBitsToUint(vec4(light.direction, light.outer_angle));
  records[4u * i + 3u] = floatBitsToUint(vec4(light.inner_angle, light.cos_outer, light.spot_scale, light.sin_outer));
}
