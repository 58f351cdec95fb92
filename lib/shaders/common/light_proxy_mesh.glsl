// The corners of the triangles that stand for a light where lights are rasterised: of its proxy, or of its mesh, which is
// cut to what its shadow map lets it light.
// Needs: `frame`, `proxies`, `meshes`.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_LIGHT_PROXY_MESH
#define LAMP_COMMON_LIGHT_PROXY_MESH
#include "common/light_mesh_view.glsl"
#include "common/light_proxy.glsl"

// Of the six triangles of a side: which rows of the profile, and whether at the side's end. Counter-clockwise from outside.
const uvec3 ROWS[6] = uvec3[](uvec3(0, 1, 1), uvec3(1, 1, 2), uvec3(1, 2, 2), uvec3(2, 2, 3), uvec3(2, 3, 3),
                              uvec3(3, 3, 4));
const uvec3 ENDS[6] = uvec3[](uvec3(0, 1, 0), uvec3(0, 1, 1), uvec3(0, 1, 0), uvec3(0, 1, 1), uvec3(0, 1, 0),
                              uvec3(0, 1, 0));

// View space. Past the last triangle: all corners in one place.
vec3 mesh_vertex(uint light, uint triangle, uint corner) {
  const uint kind = meshes[light].kind;
  const uint point = mesh_corner(kind, min(triangle, mesh_triangles(kind) - 1u), triangle < mesh_triangles(kind) ? corner : 0u);
  const MeshAxes axes = mesh_axes(frame, kind, meshes[light].axis_x, meshes[light].axis_z);
  const float reach = meshes[light].reach[point / 4u][point % 4u];
  return proxies[light].origin +
         axes.to_view * (mesh_reach(kind, point, reach, proxies[light].margin) *
                         normalize(mesh_way(kind, meshes[light].half_width, point)));
}

vec3 proxy_vertex(LightProxy proxy, uint triangle, uint corner) {
  const uint row = ROWS[triangle % 6u][corner];
  const uint side = (triangle / 6u + ENDS[triangle % 6u][corner]) % PROXY_SIDES;
  const float angle = float(side) * (4.0 * HALF_PI / float(PROXY_SIDES));
  const vec3 u = proxy.axis;
  const vec3 v = normalize(abs(u.x) < 0.7 ? cross(u, vec3(1.0, 0.0, 0.0)) : cross(u, vec3(0.0, 1.0, 0.0)));
  const vec3 w = cross(u, v);
  return proxy.origin + proxy.along[row] * u + proxy.radius[row] * (cos(angle) * v + sin(angle) * w);
}

#endif
