// A scene's vertices and indices as words, for shaders that fetch them by themselves.
// Needs: VERTEX_BINDING, INDEX_BINDING.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_VERTEX_WORDS
#define LAMP_VERTEX_WORDS

const uint VERTEX_WORDS = 15u;  // of a Vertex, scene.h: position 3, normal 3, tangent 4, two uv of 2, colour 1

layout(set = 0, binding = VERTEX_BINDING, std430) readonly buffer VertexBuffer { uint vertex_words[]; };
layout(set = 0, binding = INDEX_BINDING, std430) readonly buffer IndexBuffer { uint vertex_indices[]; };

// First words of the vertices of the triangle whose indices begin at `index`.
uvec3 vertices_at(uint index, uint vertex_offset) {
  return VERTEX_WORDS * (uvec3(vertex_indices[index], vertex_indices[index + 1u], vertex_indices[index + 2u]) + vertex_offset);
}

vec2 vertex_2(uint word) { return uintBitsToFloat(uvec2(vertex_words[word], vertex_words[word + 1u])); }
vec3 vertex_3(uint word) { return vec3(vertex_2(word), uintBitsToFloat(vertex_words[word + 2u])); }
vec2 vertex_uv(uint vertex, uint set) { return vertex_2(vertex + 10u + 2u * set); }
vec4 vertex_color(uint vertex) { return unpackUnorm4x8(vertex_words[vertex + 14u]); }

#endif
