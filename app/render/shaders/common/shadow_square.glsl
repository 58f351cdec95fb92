// What a view of a light shows of its square of the shadow atlas: all of a face or a spot, an octant of an octahedron.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_SHADOW_SQUARE
#define LAMP_SHADOW_SQUARE
#extension GL_EXT_scalar_block_layout : require
#include "shadow_data.h"

layout(set = 0, binding = 10, scalar) readonly buffer ViewBuffer { ShadowView views[]; };
layout(set = 0, binding = 12, scalar) readonly buffer MapBuffer { ShadowMap maps[]; };

// Of a square: (x, y, w) of a point, x / w and y / w in texels from the square's middle.
struct SquareView {
  mat3 rows;  // columns are x, y, w
  vec3 position;
  float near_m;
  ivec2 corner;  // texel in the atlas
  int side;
  bool is_octant;
  mat3 folds;  // of an octant, columns: a texel belongs to it where the dot products with (x, y, 1) are not negative
  ivec2 low;   // texels that may belong to it
  ivec2 high;
};

SquareView square_view(uint view, float atlas_size) {
  const uint light = views[view].light;
  const uint at = maps[light].squares[maps[light].kind == SHADOW_FACES ? views[view].view : 0u];
  SquareView square;
  square.is_octant = maps[light].kind == SHADOW_OCTAHEDRON;
  square.position = views[view].position;
  square.near_m = views[view].near_m;
  square.corner = ivec2(at & 0xffffu, at >> 16u) * int(LEAST_SQUARE);
  square.side = int(maps[light].side);
  const vec2 off_middle = 0.5 * atlas_size - (vec2(square.corner) + 0.5 * float(square.side));
  const vec3 row_w = views[view].row_w;
  square.rows = mat3(0.5 * atlas_size * views[view].row_x + off_middle.x * row_w,
                     0.5 * atlas_size * views[view].row_y + off_middle.y * row_w, row_w);
  square.low = ivec2(0);
  square.high = ivec2(square.side - 1);
  if (square.is_octant) {
    const mat3 direction_of = inverse(transpose(square.rows));
    square.folds = transpose(direction_of) * mat3(views[view].planes[0], views[view].planes[1], views[view].planes[2]);
    // An octant lies in one quarter of the square, and by less than a texel beyond it.
    const bvec2 upper = greaterThan((row_w * square.rows).xy, vec2(0.0));
    square.low = mix(square.low, ivec2(square.side / 2 - 1), upper);
    square.high = mix(ivec2(square.side / 2), square.high, upper);
  }
  return square;
}

// From the square's middle.
vec3 texel_center(SquareView square, ivec2 at) { return vec3(vec2(at) + 0.5 - 0.5 * float(square.side), 1.0); }

#endif
