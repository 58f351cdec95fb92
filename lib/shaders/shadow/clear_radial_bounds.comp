// Before several work groups a light enlarge its radial bound (radial_bounds.comp): sets all its bytes to 0.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lamplight/shared/radial.h"

layout(local_size_x = 32) in;  // a light

layout(set = 0, binding = 3, scalar) readonly buffer JobBuffer { RadialJob jobs[]; };
layout(set = 0, binding = 4, scalar) writeonly buffer BoundBuffer { RadialBound bounds[]; };
layout(push_constant) uniform Push { uint job_count; };

void main() {
  const uint number = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x;
  if (number >= job_count || jobs[number].part != 0u) return;
  const uint light = jobs[number].light;
  const uint count = uint(bounds[light].bytes.length());
  for (uint i = gl_LocalInvocationIndex; i < count; i += gl_WorkGroupSize.x) bounds[light].bytes[i] = uvec4(0u);
}
