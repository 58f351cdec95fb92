// Writes the texels that a caster's triangle covers, and finds the holes of masked materials.
// Needs: common/shadow_triangle.glsl.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_SHADOW_TEXELS
#define LAMP_SHADOW_TEXELS

layout(constant_id = 1) const bool MASKED = false;
layout(set = 0, binding = 0, r32ui) uniform uimage2D atlas;  // bits of floats, which order as the floats do
layout(set = 0, binding = 1, scalar) uniform MaterialBlock { MaterialData material; };
layout(set = 0, binding = 5) uniform sampler2D base_color_image;

vec2 corner_uv(uint vertex) {
  const TextureData t = material.base_color_texture;
  const vec2 uv = vertex_uv(vertex, t.uv);
  return vec2(dot(t.u_row, uv), dot(t.v_row, uv)) + t.offset;
}

// `edges`: of edges_at. A place on a texture is a quotient of two functions that are linear over the square.
bool is_hole(ShadowTriangle t, vec3 edges) {
  const mat3x2 uv = mat3x2(corner_uv(t.vertices.x), corner_uv(t.vertices.y), corner_uv(t.vertices.z));
  const vec3 alpha = vec3(vertex_color(t.vertices.x).a, vertex_color(t.vertices.y).a, vertex_color(t.vertices.z).a);
  const float sum = edges.x + edges.y + edges.z;
  const vec2 place = uv * edges / sum;
  const vec2 along_x = (uv * t.edge_x - place * dot(t.edge_x, vec3(1.0))) / sum;
  const vec2 along_y = (uv * t.edge_y - place * dot(t.edge_y, vec3(1.0))) / sum;
  const float texel_alpha = textureGrad(base_color_image, place, along_x, along_y).a;
  return material.base_color.a * (dot(alpha, edges) / sum) * texel_alpha < material.alpha_cutoff;
}

void draw_texel(SquareView square, ShadowTriangle t, ivec2 at) {
  const vec3 s = texel_center(square, at);
  const vec3 edges = edges_at(t, s);
  if (any(lessThan(edges, vec3(0.0))) || (square.is_octant && any(lessThan(s * square.folds, vec3(0.0))))) return;
  // Nearer than the nearest distance is drawn at it.
  const float depth = min(square.near_m * dot(t.plane, s) / t.scale, 1.0);
  if (!(depth > 0.0)) return;
  if (MASKED && is_hole(t, edges)) return;
  imageAtomicMax(atlas, square.corner + at, floatBitsToUint(depth));
}

#endif
