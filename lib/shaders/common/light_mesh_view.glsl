// A light's mesh as a view draws it: widened by a margin, and whether the eye may be inside.
// Based on: Minkowski sums. A point that lies up to a margin from a lit one is turned about the light by no more than
// MESH_SPREAD, unless it is nearer to the light than the margin over that; and no farther away than the lit one and the
// margin. So points are moved outwards by the margin, and to that distance at least.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_LIGHT_MESH_VIEW
#define LAMP_COMMON_LIGHT_MESH_VIEW
#include "common/light_mesh.glsl"
#include "lamplight/shared/frame.h"

struct MeshAxes {
  mat3 to_view;  // from the mesh's own axes
};

mat3 mesh_world_axes(uint kind, vec3 axis_x, vec3 axis_z) {
  return kind == MESH_CUBE ? mat3(1.0) : mat3(axis_x, cross(axis_z, axis_x), axis_z);
}

MeshAxes mesh_axes(Frame frame, uint kind, vec3 axis_x, vec3 axis_z) {
  return MeshAxes(mat3(frame.view_from_world) * mesh_world_axes(kind, axis_x, axis_z));
}

// Of points that nothing but closes the mesh only the ball asks for anything.
float mesh_reach(uint kind, uint point, float reach, float margin) {
  const float flatness = mesh_flatness(kind, point);
  return max(reach + flatness * margin, flatness * margin / MESH_SPREAD);
}

// Whether points move outwards by less than the light's range: else the mesh says nothing. Those that close a spot move
// three times as far as others.
bool mesh_is_fine(uint kind, float range_m, float margin) {
  return margin < (kind == MESH_CUBE ? 0.75 : 0.25) * MESH_SPREAD * range_m;
}

// Whether a point of the mesh may be a corner of the triangle that lies towards `way`, in the mesh's own axes.
bool mesh_is_towards(uint kind, float half_width, uint point, vec3 way) {
  const vec3 own = mesh_way(kind, half_width, point);
  // The largest quads of a cube are 32 degrees from corner to corner.
  if (kind == MESH_CUBE) return dot(own, way) >= 0.84 * length(own) * length(way);
  const float aside = max(abs(way.x), abs(way.y));
  if (mesh_closes(kind, point) && !(aside < 0.999 * half_width * way.z)) return true;
  const float step = 2.01 * half_width / float(MESH_SPOT_QUADS);
  return way.z > 0.0 && all(lessThanEqual(abs(own.xy - way.xy / way.z), vec2(step)));
}

#endif
