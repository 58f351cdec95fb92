// A scene for rays: its hierarchy, its vertices, its materials, and its images as plain texels, since no device need have
// more textures in a shader than a few.
// Based on: Akenine-Moeller et al., Texture Level of Detail Strategies for Real-Time Ray Tracing, Ray Tracing Gems
// (2019), chapter 20: a cone around the ray.
// A shader may say BVH_FIRST_BINDING before it includes this: eight bindings from there on.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_BVH_SCENE
#define LAMP_BVH_SCENE
#extension GL_EXT_scalar_block_layout : require
#include "bvh_data.h"
#include "mirror_data.h"
#include "common/srgb.glsl"

#ifndef BVH_FIRST_BINDING
#define BVH_FIRST_BINDING 8
#endif
#define VERTEX_BINDING (BVH_FIRST_BINDING + 3)
#define INDEX_BINDING (BVH_FIRST_BINDING + 4)
#include "common/vertex_words.glsl"

layout(set = 0, binding = BVH_FIRST_BINDING, scalar) readonly buffer BvhNodeBuffer { BvhNode bvh_nodes[]; };
layout(set = 0, binding = BVH_FIRST_BINDING + 1, scalar) readonly buffer BvhTriangleBuffer { BvhTriangle bvh_triangles[]; };
layout(set = 0, binding = BVH_FIRST_BINDING + 2, scalar) readonly buffer BvhInstanceBuffer { BvhInstance bvh_instances[]; };
layout(set = 0, binding = BVH_FIRST_BINDING + 5, scalar) readonly buffer MaterialBuffer { MirrorMaterial materials[]; };
layout(set = 0, binding = BVH_FIRST_BINDING + 6, scalar) readonly buffer ImageBuffer { MirrorImage images[]; };
layout(set = 0, binding = BVH_FIRST_BINDING + 7, std430) readonly buffer TexelBuffer { uint texels[]; };

vec3 to_world(BvhInstance instance, vec3 direction) {
  return instance.column_x * direction.x + instance.column_y * direction.y + instance.column_z * direction.z;
}

// The corners' vertices.
uvec3 vertices_of(BvhTriangle t, BvhInstance instance) { return vertices_at(t.first_index, instance.vertex_offset); }

// Of the second and the third corner, and the rest of the first.
vec3 all_weights(vec2 uv) { return vec3(1.0 - uv.x - uv.y, uv); }

// A place on a texture, 0 .. 1 over its image.
vec2 texture_place(MirrorTexture t, uvec3 vertices, vec3 weights) {
  const uint set = t.place.uv;
  const vec2 uv = weights.x * vertex_uv(vertices.x, set) + weights.y * vertex_uv(vertices.y, set) +
                  weights.z * vertex_uv(vertices.z, set);
  return vec2(dot(t.place.u_row, uv), dot(t.place.v_row, uv)) + t.place.offset;
}

uint wrapped(int at, uint size, uint wrap) {
  const int n = int(size);
  if (wrap == MIRROR_WRAP_CLAMP) return uint(clamp(at, 0, n - 1));
  const int period = wrap == MIRROR_WRAP_REPEAT ? n : 2 * n;
  int in_period = at % period;
  if (in_period < 0) in_period += period;
  return uint(in_period < n ? in_period : period - 1 - in_period);
}

// One level of an image, as a texture reads it.
struct Level {
  uint first;  // texel
  uvec2 size;
  uvec2 wrap;
  bool is_srgb;
};

vec4 linear_texel(Level level, ivec2 at) {
  const uint x = wrapped(at.x, level.size.x, level.wrap.x);
  const uint y = wrapped(at.y, level.size.y, level.wrap.y);
  vec4 color = unpackUnorm4x8(texels[level.first + y * level.size.x + x]);
  if (level.is_srgb) color.rgb = linear_of_srgb(color.rgb);
  return color;
}

// A place in its first two periods: far from 0, places are coarse. What clamps is clamped a little farther out.
float near_place(float place, uint wrap) {
  return wrap == MIRROR_WRAP_CLAMP ? clamp(place, -1.0, 2.0) : place - 2.0 * floor(place * 0.5);
}

// Between the four texels around a place of one level.
vec4 read_level(MirrorTexture t, vec2 place, uint number) {
  const MirrorImage image = images[t.image];
  Level level = Level(image.first, uvec2(image.width, image.height), uvec2(t.wrap_u, t.wrap_v), image.is_srgb != 0u);
  for (uint i = 0u; i < number; ++i) {
    level.first += level.size.x * level.size.y;
    level.size = max(level.size / 2u, uvec2(1u));
  }
  const vec2 at = vec2(near_place(place.x, t.wrap_u), near_place(place.y, t.wrap_v)) * vec2(level.size) - 0.5;
  const vec2 corner = floor(at);
  const vec2 between = at - corner;
  const ivec2 c = ivec2(corner);
  const vec4 upper = mix(linear_texel(level, c), linear_texel(level, c + ivec2(1, 0)), between.x);
  const vec4 lower = mix(linear_texel(level, c + ivec2(0, 1)), linear_texel(level, c + ivec2(1, 1)), between.x);
  return mix(upper, lower, between.y);
}

// `width`: the ray's cone's on the triangle, over the length of its sides (the root of twice its area).
vec4 read_texture(MirrorTexture t, uvec3 vertices, vec3 weights, float width) {
  if (t.image == MIRROR_NO_IMAGE) return vec4(1.0);
  const vec2 a = vertex_uv(vertices.x, t.place.uv);
  const vec2 b = vertex_uv(vertices.y, t.place.uv) - a;
  const vec2 c = vertex_uv(vertices.z, t.place.uv) - a;
  const vec2 size = vec2(images[t.image].width, images[t.image].height);
  const float turned_area = abs((t.place.u_row.x * t.place.v_row.y - t.place.u_row.y * t.place.v_row.x) * (b.x * c.y - b.y * c.x));
  const float side_texels = sqrt(turned_area * size.x * size.y);
  const float level = log2(max(side_texels * width, 1.0));
  return read_level(t, texture_place(t, vertices, weights), min(uint(level + 0.5), images[t.image].levels - 1u));
}

// Whether a masked material is cut out there, at its finest level.
bool is_hole(BvhTriangle t, BvhInstance instance, vec2 uv) {
  const MirrorTexture from = materials[instance.material].base_color;
  const uvec3 vertices = vertices_of(t, instance);
  const vec3 weights = all_weights(uv);
  float alpha = materials[instance.material].factors.base_color.a *
      dot(weights, vec3(vertex_color(vertices.x).a, vertex_color(vertices.y).a, vertex_color(vertices.z).a));
  if (from.image != MIRROR_NO_IMAGE) alpha *= read_level(from, texture_place(from, vertices, weights), 0u).a;
  return alpha < materials[instance.material].factors.alpha_cutoff;
}

#endif
