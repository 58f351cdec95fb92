// Where the points of a light's mesh lie, and which of them are a triangle's corners (shared/light_mesh.h).
// Based on: cube maps' inverse depth 1 / w is linear over a face, so a triangle that is flat in space is linear between
// its corners' inverse depths.
// Promise: a point shared by triangles has one number, so the mesh is closed; counter-clockwise from outside.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_LIGHT_MESH
#define LAMP_COMMON_LIGHT_MESH
#include "lamplight/shared/light_mesh.h"

const uint MESH_SPOT_FRONT = (MESH_SPOT_QUADS + 1u) * (MESH_SPOT_QUADS + 1u);

// Points of the surface of a cube of n steps a side: all of z = 0, all of z = n, then rings between.
uint cube_points(uint n) { return 2u * (n + 1u) * (n + 1u) + 4u * n * (n - 1u); }

uint cube_ring(uvec2 at, uint n) {
  if (at.y == 0u) return at.x;
  if (at.y == n) return n + 1u + at.x;
  return 2u * (n + at.y) + (at.x == 0u ? 0u : 1u);
}

uint cube_point(uvec3 at, uint n) {
  const uint layer = (n + 1u) * (n + 1u);
  if (at.z == 0u) return at.x + (n + 1u) * at.y;
  if (at.z == n) return layer + at.x + (n + 1u) * at.y;
  return 2u * layer + 4u * n * (at.z - 1u) + cube_ring(at.xy, n);
}

uvec3 cube_place(uint point, uint n) {
  const uint layer = (n + 1u) * (n + 1u);
  const uint in_layer = point % layer;
  if (point < 2u * layer) return uvec3(in_layer % (n + 1u), in_layer / (n + 1u), point < layer ? 0u : n);
  const uint z = (point - 2u * layer) / (4u * n) + 1u;
  const uint ring = (point - 2u * layer) % (4u * n);
  if (ring <= n) return uvec3(ring, 0u, z);
  if (ring <= 2u * n + 1u) return uvec3(ring - n - 1u, n, z);
  return uvec3((ring & 1u) * n, ring / 2u - n, z);
}

// Faces as those of a shadow map: +x -x +y -y +z -z. `at`: along the two axes that follow the face's own.
uvec3 cube_face_place(uint face, uvec2 at, uint n) {
  const uvec3 turned = uvec3(at, (face & 1u) == 0u ? n : 0u);
  return face / 2u == 0u ? turned.zxy : face / 2u == 1u ? turned.yzx : turned;
}

vec3 cube_turned(uint face, vec3 v) { return face / 2u == 0u ? v.yzx : face / 2u == 1u ? v.zxy : v; }

// To a face's own axes, where it lies at depth > 0.
vec3 cube_face_axes(uint face, vec3 v) {
  const vec3 turned = cube_turned(face, v);
  return vec3(turned.xy, (face & 1u) == 0u ? turned.z : -turned.z);
}

uint mesh_quads(uint kind) { return kind == MESH_CUBE ? MESH_CUBE_QUADS : MESH_SPOT_QUADS; }
uint mesh_points(uint kind) { return kind == MESH_CUBE ? MESH_POINTS : MESH_SPOT_FRONT + MESH_SPOT_BACK; }

// Of a face's grid; a spot has one face.
uint mesh_point(uint kind, uint face, uvec2 at) {
  if (kind == MESH_CUBE) return cube_point(cube_face_place(face, at, MESH_CUBE_QUADS), MESH_CUBE_QUADS);
  return at.x + (MESH_SPOT_QUADS + 1u) * at.y;
}

// Of a point, at depth 1, in world axes for a cube, in its own for a spot.
vec3 mesh_way(uint kind, float half_width, uint point) {
  if (kind == MESH_CUBE) return vec3(cube_place(point, MESH_CUBE_QUADS)) * (2.0 / float(MESH_CUBE_QUADS)) - 1.0;
  if (point >= MESH_SPOT_FRONT) return vec3(((point & 1u) == 0u ? -1.0 : 1.0), ((point & 2u) == 0u ? -1.0 : 1.0), -1.0);
  const vec2 at = vec2(point % (MESH_SPOT_QUADS + 1u), point / (MESH_SPOT_QUADS + 1u));
  return vec3((at * (2.0 / float(MESH_SPOT_QUADS)) - 1.0) * half_width, 1.0);
}

// Whether nothing but the ball around the light asks for the point: those at the rim and behind.
bool mesh_closes(uint kind, uint point) {
  if (kind == MESH_CUBE) return false;
  const uvec2 at = uvec2(point % (MESH_SPOT_QUADS + 1u), point / (MESH_SPOT_QUADS + 1u));
  return point >= MESH_SPOT_FRONT || at.x % MESH_SPOT_QUADS == 0u || at.y % MESH_SPOT_QUADS == 0u;
}

// How much more than a distance from the light all corners of a triangle must be away, for the whole triangle to be so;
// and by how much more they must be moved outwards for the triangle to move by a distance.
float mesh_flatness(uint kind, uint point) { return kind == MESH_CUBE ? 1.05 : mesh_closes(kind, point) ? 3.0 : 1.3; }

const uvec2 MESH_QUAD[4] = uvec2[](uvec2(0, 0), uvec2(1, 0), uvec2(1, 1), uvec2(0, 1));

uint mesh_grid_corner(uint kind, uint triangle, uint corner) {
  const uint n = mesh_quads(kind);
  const uint quad = triangle / 2u % (n * n);
  const uint face = triangle / (2u * n * n);
  uint i = corner == 0u ? 0u : corner + (triangle & 1u);
  if ((face & 1u) != 0u && corner != 0u) i = 3u + 2u * (triangle & 1u) - i;  // seen from the other side
  return mesh_point(kind, face, uvec2(quad % n, quad / n) + MESH_QUAD[i]);
}

// Of the rim, around it from (0, 0), seen from the light's front: counter-clockwise.
uint mesh_rim(uint side, uint step) {
  const uint n = MESH_SPOT_QUADS;
  return mesh_point(MESH_SPOT, 0u,
                    side == 0u   ? uvec2(step, 0u)
                    : side == 1u ? uvec2(n, step)
                    : side == 2u ? uvec2(n - step, n)
                                 : uvec2(0u, n - step));
}

// Four sides of MESH_SPOT_QUADS + 1 triangles, then two at the back.
uint mesh_closing_corner(uint triangle, uint corner) {
  const uint n = MESH_SPOT_QUADS;
  const uint middle = (n + 1u) / 2u;
  const uint around[4] = uint[](0u, 1u, 3u, 2u);
  const uint side = triangle / (n + 1u);
  const uint step = triangle % (n + 1u);
  if (side >= 4u) return MESH_SPOT_FRONT + (corner == 0u ? 0u : around[4u - corner - step]);
  const uint from = MESH_SPOT_FRONT + around[side];
  const uint to = MESH_SPOT_FRONT + around[(side + 1u) % 4u];
  if (step == n) return corner == 0u ? mesh_rim(side, middle) : corner == 1u ? from : to;
  if (corner == 2u) return step < middle ? from : to;
  return mesh_rim(side, step + 1u - corner);
}

uint mesh_triangles(uint kind) {
  return kind == MESH_CUBE ? 12u * MESH_CUBE_QUADS * MESH_CUBE_QUADS
                           : 2u * MESH_SPOT_QUADS * MESH_SPOT_QUADS + 4u * (MESH_SPOT_QUADS + 1u) + 2u;
}

uint mesh_corner(uint kind, uint triangle, uint corner) {
  const uint grid = 2u * MESH_SPOT_QUADS * MESH_SPOT_QUADS;
  if (kind == MESH_SPOT && triangle >= grid) return mesh_closing_corner(triangle - grid, corner);
  return mesh_grid_corner(kind, triangle, corner);
}

// Of a place in a quad, 0 .. 1, the shares of its corners in the order of MESH_QUAD: of the two triangles the one that
// holds it.
vec4 mesh_shares(vec2 at) {
  return at.x >= at.y ? vec4(1.0 - at.x, at.x - at.y, at.y, 0.0) : vec4(1.0 - at.y, 0.0, at.x, at.y - at.x);
}

#endif
