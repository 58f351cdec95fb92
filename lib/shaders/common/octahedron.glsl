// Directions on an octahedron |x| + |y| + |z| = 1 that is spread out on a square, -1 .. 1 a side, in GLSL and HLSL.
// Based on: Praun, Hoppe, Spherical Parametrization and Remeshing, SIGGRAPH (2003). Promise: the same bits everywhere.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_OCTAHEDRON
#define LAMP_COMMON_OCTAHEDRON

float octahedron_sign(float x) { return x < 0.0 ? -1.0 : 1.0; }

// From the lower half, z < 0: (x, y) of the octahedron to the square's corners.
vec2 octahedron_folded(vec2 p) {
  precise const vec2 folded =
      vec2((1.0 - abs(p.y)) * octahedron_sign(p.x), (1.0 - abs(p.x)) * octahedron_sign(p.y));
  return folded;
}

// The octahedron's point at a place on the square. The solid angle of an area there is the area over the cube of the
// point's distance, up to a factor.
vec3 octahedron_point(vec2 p) {
  const float z = 1.0 - abs(p.x) - abs(p.y);
  return vec3(z < 0.0 ? octahedron_folded(p) : p, z);
}

// A texel of a square of side x side: beyond an edge the octahedron goes on beside the middle of that edge, turned
// around.
ivec2 octahedron_texel(ivec2 texel, int side) {
  ivec2 t = texel;
  if (t.x < 0 || t.x >= side) t = ivec2(t.x < 0 ? -1 - t.x : 2 * side - 1 - t.x, side - 1 - t.y);
  if (t.y < 0 || t.y >= side) t = ivec2(side - 1 - t.x, t.y < 0 ? -1 - t.y : 2 * side - 1 - t.y);
  return t;
}

#endif
