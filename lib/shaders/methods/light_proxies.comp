// One thread a light: its proxy, and its place among those that are drawn from outside or from inside.
// Based on: Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017), rasterised culling.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/light_mesh_view.glsl"
#include "common/light_proxy.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint CAPACITY = 1;      // lights, of each part of `drawn`
layout(constant_id = 1) const uint REACH_1024 = 0;    // how far a sample may be from a pixel's centre, pixels / 1024
layout(constant_id = 2) const bool CUT = false;       // lights are cut to their meshes
layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) readonly buffer LightBuffer { Light lights[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer ProxyBuffer { LightProxy proxies[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer DrawnBuffer { uint drawn[]; };  // lights, of each draw
layout(set = 0, binding = 4, scalar) buffer DrawBuffer { ProxyDraw draws[]; };
layout(set = 0, binding = 5, scalar) readonly buffer MeshBuffer { LightMesh meshes[]; };

bool is_cut(uint light, LightProxy proxy) {
  if (!CUT || light >= uint(meshes.length()) || lights[light].range > EVERYWHERE_M) return false;
  return meshes[light].kind != MESH_NONE && mesh_is_fine(meshes[light].kind, lights[light].range, proxy.margin);
}

// Depths between which the mesh lies, without the margin, and whether the eye may be inside, with it.
bool narrow_to_mesh(uint light, inout LightProxy proxy) {
  const uint kind = meshes[light].kind;
  const float half_width = meshes[light].half_width;
  const mat3 axes = mesh_world_axes(kind, meshes[light].axis_x, meshes[light].axis_z);
  const vec3 ahead = transpose(axes) * -vec3(frame.view_from_world[0].z, frame.view_from_world[1].z,
                                             frame.view_from_world[2].z);
  const bool perspective = is_perspective(frame);
  vec3 eye = vec3(0.0);
  if (perspective)
    eye = transpose(axes) * ((frame.world_from_view * vec4(projection_eye(frame), 1.0)).xyz - meshes[light].position);
  float least = 0.0;
  float most = 0.0;
  float towards_eye = 0.0;
  for (uint point = 0u; point < mesh_points(kind); ++point) {
    const float reach = meshes[light].reach[point / 4u][point % 4u];
    const float along = dot(ahead, normalize(mesh_way(kind, half_width, point))) * reach;
    least = min(least, along);
    most = max(most, along);
    if (mesh_is_towards(kind, half_width, point, eye))
      towards_eye = max(towards_eye, mesh_reach(kind, point, reach, proxy.margin));
  }
  const float own = -proxy.origin.z;
  const float rounding = 4.0 * (ROUND_RADIUS + frame.stretch) * lights[light].range +
                         8.0 * ROUND_POSITION * (length(proxy.origin) + length(lights[light].position) + length(frame.eye_world));
  proxy.z_near = max(proxy.z_near, own + least - rounding);
  proxy.z_far = min(proxy.z_far, own + most + rounding);
  return perspective && !(length(eye) > 1.001 * towards_eye + rounding);
}

void main() {
  const uint light = gl_GlobalInvocationID.x;
  if (light == 0u) {
    draws[PROXIES_OUTSIDE].vertices = PROXY_VERTICES;
    draws[PROXIES_INSIDE].vertices = PROXY_VERTICES;
    if (CUT) draws[CUT_OUTSIDE].vertices = MESH_VERTICES;
    if (CUT) draws[CUT_INSIDE].vertices = MESH_VERTICES;
  }
  if (light >= light_count_of(frame)) return;
  const LightBounds sphere = light_bounds(frame, lights[light]);
  if (sphere.radius < 0.0) return;
  LightProxy proxy = light_proxy(frame, lights[light], sphere, float(REACH_1024) / 1024.0);
  const bool perspective = is_perspective(frame);
  const bool everywhere = lights[light].range > EVERYWHERE_M;
  uint which = PROXIES_OUTSIDE;
  if (is_cut(light, proxy))
    which = narrow_to_mesh(light, proxy) ? CUT_INSIDE : CUT_OUTSIDE;
  else if (everywhere || perspective && may_be_inside(proxy, projection_eye(frame)))
    which = PROXIES_INSIDE;
  proxies[light] = proxy;
  // The order among them is that of arrival; bits do not depend on it.
  drawn[which * CAPACITY + atomicAdd(draws[which].instances, 1u)] = light;
}
