// Whether a light's mesh holds a point. Where it says no, the shadow look-up lights the point with no normal and no seed.
// Needs: MESH_BINDING.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_LIGHT_MESH_HOLDS
#define LAMP_COMMON_LIGHT_MESH_HOLDS
#include "common/light_mesh.glsl"

layout(set = 0, binding = MESH_BINDING, scalar) readonly buffer MeshBuffer { LightMesh meshes[]; };

const float MESH_ROUNDING = 1e-5;

uint mesh_face_of(vec3 v) {
  const vec3 a = abs(v);
  const uint major = a.x >= a.y && a.x >= a.z ? 0u : a.y >= a.z ? 1u : 2u;
  return 2u * major + (v[major] < 0.0 ? 1u : 0u);
}

// 1 / depth of the mesh, where it crosses a direction.
float mesh_inverse_depth(uint light, uint face, vec2 at) {
  const uint kind = meshes[light].kind;
  const uvec2 quad = uvec2(clamp(at, 0.0, float(mesh_quads(kind)) - 0.5));
  const vec4 shares = mesh_shares(at - vec2(quad));
  float inverse = 0.0;
  for (uint i = 0u; i < 4u; ++i) {
    const uint point = mesh_point(kind, face, quad + MESH_QUAD[i]);
    const float far = length(mesh_way(kind, meshes[light].half_width, point));
    inverse += shares[i] * far / meshes[light].reach[point / 4u][point % 4u];
  }
  return inverse;
}

bool mesh_holds(uint light, vec3 position) {
  const uint kind = meshes[light].kind;
  if (kind == MESH_NONE) return true;
  vec3 rel = position - meshes[light].position;
  uint face = 0u;
  float half_width = 1.0;
  if (kind == MESH_SPOT) {
    const vec3 x = meshes[light].axis_x;
    const vec3 z = meshes[light].axis_z;
    rel = vec3(dot(x, rel), dot(cross(z, x), rel), dot(z, rel));
    half_width = meshes[light].half_width;
    if (!(rel.z > 0.0) || max(abs(rel.x), abs(rel.y)) > half_width * rel.z) return false;
  } else {
    face = mesh_face_of(rel);
    rel = cube_turned(face, rel);
    rel.z = abs(rel.z);
    if (!(rel.z > 0.0)) return true;
  }
  const vec2 at = (rel.xy / (rel.z * half_width) + 1.0) * (0.5 * float(mesh_quads(kind)));
  return rel.z * mesh_inverse_depth(light, face, at) <= 1.0 + MESH_ROUNDING;
}

#endif
