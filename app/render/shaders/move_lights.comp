// Lights to where their paths have them at a time: the same bits as position_at() (scene/light_path.h). A thread takes
// every so manieth light.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lamplight/shared/light.h"
#include "light_path_data.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer PathBuffer { LightPathData paths[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer LightBuffer { Light lights[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer SphereBuffer { LightSphere spheres[]; };
layout(push_constant, scalar) uniform Push { MoveLights moves; };

// a * b + c * d, rounded to 30 bits less.
int mixed_fixed(int a, int b, int c, int d) {
  int high;
  int low;
  imulExtended(a, b, high, low);
  int other_high;
  int other_low;
  imulExtended(c, d, other_high, other_low);
  uint carry;
  uint sum = uaddCarry(uint(low), uint(other_low), carry);
  high += other_high + int(carry);
  sum = uaddCarry(sum, 1u << 29, carry);
  high += int(carry);
  return int(uint(high) << 2 | sum >> 30);
}

void main() {
  for (uint i = gl_GlobalInvocationID.x; i < moves.count; i += gl_NumWorkGroups.x * gl_WorkGroupSize.x) {
    const LightPathData path = paths[i];
    vec3 position;
    for (int axis = 0; axis < 3; ++axis) {
      const uint waves = path.waves >> 2 * axis & PATH_WAVES;
      const int swing = mixed_fixed(path.sine[axis], moves.cosine[waves], path.cosine[axis], moves.sine[waves]);
      precise const float share = float(swing) * (1.0 / 1073741824.0);
      precise const float away = path.amplitude[axis] * share;
      precise const float at = path.middle[axis] + away;
      position[axis] = at;
    }
    lights[moves.first + i].position = position;
    if ((path.waves & PATH_SPHERE_STAYS) != 0u) continue;
    precise const vec3 center = position + path.to_center;
    spheres[moves.first + i].center = center;
  }
}
