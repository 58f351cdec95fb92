// The corners of lights' meshes, widened by a margin: world space, from the light. A thread a triangle, a row of groups a
// light.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "common/light_mesh_view.glsl"
#include "mesh_corner.h"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint MARGIN_MM = 0;
layout(set = 0, binding = 0, scalar) readonly buffer MeshBuffer { LightMesh meshes[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer CornerBuffer { MeshCorner corners[]; };

void main() {
  const uint triangle = gl_GlobalInvocationID.x;
  const uint light = gl_WorkGroupID.y;
  const uint kind = meshes[light].kind;
  if (kind == MESH_NONE || triangle >= mesh_triangles(kind)) return;
  const mat3 axes = mesh_world_axes(kind, meshes[light].axis_x, meshes[light].axis_z);
  for (uint i = 0u; i < 3u; ++i) {
    const uint point = mesh_corner(kind, triangle, i);
    const float reach = mesh_reach(kind, point, meshes[light].reach[point / 4u][point % 4u], 1e-3 * float(MARGIN_MM));
    const vec3 way = normalize(mesh_way(kind, meshes[light].half_width, point));
    const uint at = light * MESH_VERTICES + 3u * triangle + i;
    corners[at].position = axes * (reach * way);
    corners[at].point = point + 1u;
    corners[at].way = axes * way;
    corners[at].flatness = mesh_flatness(kind, point);
  }
}
