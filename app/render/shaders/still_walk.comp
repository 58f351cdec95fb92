// Walks lists of still lights at many points: how many lights each names, and a hash of them in their order.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "still_data.h"
#include "world/triangle_lists.glsl"
#define WORLD_TREE_WORD(word) triangle_words[word]  // the same buffer
#include "world/world_tree.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 19) const uint STILL_LISTS = STILL_OFF;
layout(set = 0, binding = 0, scalar) readonly buffer PointBuffer { StillPoint points[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer WalkBuffer { StillWalk walks[]; };
layout(push_constant) uniform Push { uint point_count; };

void meet(inout StillWalk met, uint light) {
  ++met.lights;
  met.hash = (met.hash ^ light) * STILL_HASH_TIMES;
}

void main() {
  const uint point = gl_GlobalInvocationID.x;
  if (point >= point_count) return;
  const StillPoint at = points[point];
  StillWalk met = StillWalk(0u, STILL_HASH_FIRST);
  uint light;
  if (STILL_LISTS == STILL_TRIANGLES)
    for (TriangleWalk walk = triangle_walk_begin(at.triangle, at.position); triangle_walk_next(walk, light);)
      meet(met, light);
  if (STILL_LISTS == STILL_TREE)
    for (TreeWalk walk = tree_walk_begin(at.position); tree_walk_next(walk, light);) meet(met, light);
  walks[point] = met;
}
