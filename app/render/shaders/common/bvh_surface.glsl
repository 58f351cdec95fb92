// The surface that a ray met, from its triangle's vertices and material: what the G-buffer holds of a pixel.
// Based on: Khronos, glTF 2.0, 3.9.
// Needs: common/bvh_scene.glsl, common/mirror.glsl.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_BVH_SURFACE
#define LAMP_BVH_SURFACE
#include "common/emission.glsl"

vec3 interpolated_3(uvec3 words, vec3 weights) {
  return weights.x * vertex_3(words.x) + weights.y * vertex_3(words.y) + weights.z * vertex_3(words.z);
}

// Unit; `flat_normal` where the mesh's own is none.
vec3 mapped_normal(MirrorMaterial m, BvhInstance instance, uvec3 vertices, vec3 weights, vec3 flat_normal, float width) {
  if ((instance.kind & BVH_FLATTENED) != 0u) return flat_normal;
  const vec3 own = interpolated_3(vertices + 3u, weights);
  // By the inverse's transpose.
  vec3 z = instance.row_x * own.x + instance.row_y * own.y + instance.row_z * own.z;
  const float size = max(abs(z.x), max(abs(z.y), abs(z.z)));
  if (!(size > 0.0)) return flat_normal;
  z = normalize(z / size);  // its square may be more than 32 bits hold, where a mesh is made very small
  if (m.normal.image == MIRROR_NO_IMAGE) return z;
  const vec3 tangent = to_world(instance, interpolated_3(vertices + 6u, weights));
  const vec3 x = normalize(tangent - z * dot(z, tangent) + vec3(1e-12));
  const vec3 y = cross(z, x) * uintBitsToFloat(vertex_words[vertices.x + 9u]);
  vec3 read = read_texture(m.normal, vertices, weights, width).xyz * 2.0 - 1.0;
  read.xy *= m.factors.normal_scale;
  return normalize(x * read.x + y * read.y + z * read.z);
}

MirrorSurface surface_at(MirrorHit hit, MirrorRay ray, float pixel_angle) {
  const BvhTriangle t = bvh_triangles[hit.triangle];
  const BvhInstance instance = bvh_instances[hit.instance];
  const MirrorMaterial m = materials[instance.material];
  const vec3 weights = all_weights(vec2(hit.u, hit.v));
  const vec3 position = to_world(instance, t.a * weights.x + t.b * weights.y + t.c * weights.z) + instance.origin;
  const vec3 ab = to_world(instance, t.b - t.a);
  const vec3 ac = to_world(instance, t.c - t.a);
  const vec3 longest = max(abs(ab), abs(ac));
  const float size = max(longest.x, max(longest.y, max(longest.z, 1e-30)));
  const vec3 across = cross(ab / size, ac / size);  // of edges as they are, its square may be more than 32 bits hold
  const float twice_area = length(across);          // in squares of that size
  const vec3 geometric = across / max(twice_area, 1e-30);
  const bool front = dot(geometric, ray.direction) < 0.0;
  // The pixel's cone, as wide as the way is long, over the length of the triangle's sides; as seen, not as it lies.
  const float width = pixel_angle * distance(position, ray.origin) / (size * sqrt(max(twice_area, 1e-30)));
  const uvec3 vertices = vertices_of(t, instance);
  vec3 normal = mapped_normal(m, instance, vertices, weights, geometric, width);
  if (!front) normal = -normal;
  const vec4 own_color = mat3x4(vertex_color(vertices.x), vertex_color(vertices.y), vertex_color(vertices.z)) * weights;
  const vec4 color = m.factors.base_color * own_color * read_texture(m.base_color, vertices, weights, width);
  const vec4 read = read_texture(m.metallic_roughness, vertices, weights, width);
  const float occlusion = mix(1.0, read_texture(m.occlusion, vertices, weights, width).r, m.factors.occlusion_strength);
  const vec3 emission = kept_emission(m.factors.emissive * read_texture(m.emissive, vertices, weights, width).rgb);
  const uvec2 packed = pack_surface(normal, m.factors.metallic * read.b, clamp(m.factors.roughness * read.g, 0.045, 1.0), occlusion);
  MirrorSurface s;
  s.position = position;
  s.normal = packed.x;
  s.factors = packed.y;
  s.base_color = packUnorm4x8(vec4(srgb_of_linear(color.rgb), 1.0));
  s.emission = uvec2(packHalf2x16(emission.xy), packHalf2x16(vec2(emission.z, 1.0)));
  return s;
}

#endif
