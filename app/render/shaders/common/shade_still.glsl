// The light of lights that stand still, from lists that were made ahead. Their records lie behind those of the picture's
// entities, so that these come first in a sum.
// Needs: `frame`, common/lights.glsl.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_SHADE_STILL
#define LAMP_SHADE_STILL
#include "common/lights.glsl"
#include "still_data.h"
#include "world/triangle_lists.glsl"
#define WORLD_TREE_WORD(word) triangle_words[word]  // the same buffer
#include "world/world_tree.glsl"

layout(constant_id = 19) const uint STILL_LISTS = STILL_OFF;

void add_still(inout vec3 sum, Reflector r, uint triangle) {
  if (STILL_LISTS == STILL_TRIANGLES) {
    uint light;
    for (TriangleWalk walk = triangle_walk_begin(triangle, r.position); triangle_walk_next(walk, light);)
      add_light(sum, r, frame.light_count + light);
  }
  if (STILL_LISTS == STILL_TREE) {
    uint light;
    for (TreeWalk walk = tree_walk_begin(r.position); tree_walk_next(walk, light);)
      add_light(sum, r, frame.light_count + light);
  }
}

#endif
