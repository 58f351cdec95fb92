// Draws light proxies, an instance a light. Depth is not clipped: fragments compare it by themselves.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/light_proxy.glsl"
#include "common/light_mesh_view.glsl"
#include "methods/raster_inputs.glsl"

layout(set = 0, binding = 4, scalar) readonly buffer MeshBuffer { LightMesh meshes[]; };  // of cut lights
#include "common/light_proxy_mesh.glsl"

layout(location = 0) flat out uint out_light;
layout(location = 1) out float out_z_view;

// From the picture to raster pixels, of which the last ones may stick out.
vec4 to_raster(vec4 clip) {
  const vec2 raster = vec2(squares_across(frame, RASTER_PX) * RASTER_PX);
  const vec2 xy = (clip.xy + clip.w) * (vec2(frame.size_px) / raster) - clip.w;
  return vec4(xy, 0.5 * clip.w, clip.w);
}

void main() {
  const uint light = drawn[WHICH * CAPACITY + gl_InstanceIndex];
  const uint triangle = uint(gl_VertexIndex) / 3u;
  uint corner = uint(gl_VertexIndex) % 3u;
  out_light = light;
  // One triangle over the screen, a back face. Also where a device that snaps corners coarsely would draw back faces
  // around the eye: nothing asks how deep they lie, and of a large light it loses faces that it cuts at the picture's edge.
  if (lights[light].range > EVERYWHERE_M || (INSIDE && !FACE_DEPTHS)) {
    const vec2 at = vec2(corner == 1u ? 3.0 : -1.0, corner == 2u ? 3.0 : -1.0);
    gl_Position = triangle == 0u ? vec4(at, 0.5, 1.0) : vec4(2.0, 2.0, 0.5, 1.0);
    out_z_view = INFINITE_RADIUS;
    return;
  }
  const mat4 m = frame.clip_from_view;
  bool mirrored = m[0][0] * m[1][1] > 0.0;
  if (IS_CUT && determinant(mat3(frame.view_from_world)) < 0.0) mirrored = !mirrored;  // others are made in view space
  if (mirrored && corner != 0u) corner = 3u - corner;
  vec3 position;
  if (IS_CUT)
    position = mesh_vertex(light, triangle, corner);
  else
    position = proxy_vertex(proxies[light], triangle, corner);
  out_z_view = -position.z;
  gl_Position = to_raster(m * vec4(position, 1.0));
}
