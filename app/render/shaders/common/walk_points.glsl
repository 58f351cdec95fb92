// Walks a look-up by position at many points: how many lights each names, and then which.
// Promise: its loops are the walk's alone, so that a device which ends loops ends them where it ends the walk.
// Needs: a look-up by position.
// SPDX-License-Identifier: Apache-2.0
#include "common/loops_ended.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer PointBuffer { vec3 points[]; };
layout(set = 0, binding = 1, scalar) buffer CountBuffer { uint counts[]; };  // or with `lists` where each list begins
layout(set = 0, binding = 2, scalar) writeonly buffer EndedBuffer { uint ended[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer ListBuffer { uint lists[]; };
layout(push_constant) uniform Push {
  uint point_count;
  uint writes;  // lists
  uint two;     // for loops_ended
};

void main() {
  const uint point = gl_GlobalInvocationID.x;
  if (point >= point_count) return;
  const uint first = writes != 0u ? counts[point] : 0u;
  uint count = 0u;
  uint light;
  for (Walk walk = world_walk_begin(points[point]); world_walk_next(walk, light);) {
    if (writes != 0u) lists[first + count] = light;
    ++count;
  }
  if (writes == 0u) counts[point] = count;
  ended[point] = loops_ended(two) ? 1u : 0u;
}
