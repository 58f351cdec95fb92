// Shapes around lights, by the functions that culling draws and tests them with. A thread a triangle, a row of groups a
// light.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lamplight/shared/frame.h"
#include "lamplight/shared/light_mesh.h"
#include "lamplight/shared/proxy.h"
#include "lamplight/shared/radial.h"
#include "light_outline_data.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) readonly buffer ProxyBuffer { LightProxy proxies[]; };
layout(set = 0, binding = 2, scalar) readonly buffer MeshBuffer { LightMesh meshes[]; };
layout(set = 0, binding = 3, scalar) readonly buffer RadialBuffer { RadialBound radial_bounds[]; };
layout(set = 0, binding = 4, scalar) readonly buffer JobBuffer { OutlineJob jobs[]; };
layout(set = 0, binding = 5, scalar) writeonly buffer CornerBuffer { OutlineCorner corners[]; };
#include "common/light_proxy_mesh.glsl"
#include "common/octahedron.glsl"

vec3 to_world(vec3 view) { return (frame.world_from_view * vec4(view, 1.0)).xyz; }

vec3 own_mesh_vertex(uint light, uint triangle, uint corner) {
  const uint kind = meshes[light].kind;
  const uint point = mesh_corner(kind, triangle, corner);
  const float reach = mesh_reach(kind, point, meshes[light].reach[point / 4u][point % 4u], 0.0);
  return meshes[light].position + mesh_world_axes(kind, meshes[light].axis_x, meshes[light].axis_z) *
                                      (reach * normalize(mesh_way(kind, meshes[light].half_width, point)));
}

// The way to a place of the bytes, 0 .. RADIAL_SIDE along each side, world axes.
vec3 radial_way(uint light, vec2 place) {
  if (radial_bounds[light].kind == RADIAL_SPOT) {
    const vec3 x = radial_bounds[light].axis_x;
    const vec3 z = radial_bounds[light].axis_z;
    const vec2 aside = (place - 0.5 * float(RADIAL_SIDE)) / radial_bounds[light].scale;
    return normalize(mat3(x, cross(z, x), z) * vec3(aside, 1.0));
  }
  return normalize(octahedron_point(place * (2.0 / float(RADIAL_SIDE)) - 1.0));
}

vec3 bound_vertex(uint light, uint triangle, uint corner) {
  const uint i = triangle / 2u;  // the byte
  const uint reach = radial_bounds[light].bytes[i / 16u][i / 4u % 4u] >> (8u * (i % 4u)) & 255u;
  const uint at = (triangle & 1u) * 2u + corner & 3u;  // around the patch
  const vec2 place = vec2(i % RADIAL_SIDE, i / RADIAL_SIDE) + vec2(at == 1u || at == 2u ? 1.0 : 0.0, at >= 2u ? 1.0 : 0.0);
  return radial_bounds[light].position + float(reach) * radial_bounds[light].unit_m * radial_way(light, place);
}

uint triangles_of(uint light, uint shape) {
  if (shape == OUTLINE_PROXY) return PROXY_VERTICES / 3u;
  if (shape == OUTLINE_BOUND) {
    const bool known = light < uint(radial_bounds.length()) && radial_bounds[light].kind != RADIAL_NONE;
    return known ? 2u * RADIAL_SIDE * RADIAL_SIDE : 0u;
  }
  const bool known = light < uint(meshes.length()) && meshes[light].kind != MESH_NONE;
  return known ? mesh_triangles(meshes[light].kind) : 0u;
}

vec3 vertex_of(uint light, uint shape, uint triangle, uint corner) {
  if (shape == OUTLINE_PROXY) return to_world(proxy_vertex(proxies[light], triangle, corner));
  if (shape == OUTLINE_CUT) return to_world(mesh_vertex(light, triangle, corner));
  if (shape == OUTLINE_MESH) return own_mesh_vertex(light, triangle, corner);
  return bound_vertex(light, triangle, corner);
}

void main() {
  const uint triangle = gl_GlobalInvocationID.x;
  const OutlineJob job = jobs[gl_WorkGroupID.y];
  if (triangle >= OUTLINE_TRIANGLES) return;
  const bool is_there = triangle < triangles_of(job.light, job.shape);
  for (uint i = 0u; i < 3u; ++i) {
    const vec3 position = is_there ? vertex_of(job.light, job.shape, triangle, i) : vec3(0.0);
    corners[gl_WorkGroupID.y * OUTLINE_VERTICES + 3u * triangle + i] = OutlineCorner(position, is_there ? 1u : 0u);
  }
}
