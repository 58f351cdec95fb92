// From a material and interpolated vertex attributes to a surface. Textures that a material lacks read as 1.
// Based on: Khronos, glTF 2.0, 3.9; KHR_texture_transform.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_MATERIAL
#define LAMP_MATERIAL
#extension GL_EXT_scalar_block_layout : require
#include "scene_data.h"

layout(set = 0, binding = 1, scalar) readonly buffer MaterialBuffer { MaterialData materials[]; };
layout(set = 0, binding = 5) uniform sampler2D base_color_image;
layout(set = 0, binding = 6) uniform sampler2D metallic_roughness_image;
layout(set = 0, binding = 7) uniform sampler2D normal_image;
layout(set = 0, binding = 8) uniform sampler2D occlusion_image;
layout(set = 0, binding = 9) uniform sampler2D emissive_image;
layout(push_constant) uniform Push { uint material_index; };

layout(location = 0) in vec3 in_normal;
layout(location = 1) in vec4 in_tangent;
layout(location = 2) in vec2 in_uv0;
layout(location = 3) in vec2 in_uv1;
layout(location = 4) in vec4 in_color;

vec4 texel(sampler2D image, TextureData t) {
  const vec2 uv = t.uv == 0u ? in_uv0 : in_uv1;
  const vec4 read = texture(image, vec2(dot(t.u_row, uv), dot(t.v_row, uv)) + t.offset);
  return t.present == 0u ? vec4(1.0) : read;
}

vec4 material_color() {
  const MaterialData m = materials[material_index];
  return m.base_color * in_color * texel(base_color_image, m.base_color_texture);
}

bool is_cut_out(float alpha) {
  const MaterialData m = materials[material_index];
  return m.alpha_mode == ALPHA_MASK && alpha < m.alpha_cutoff;
}

// Back faces of double-sided materials turn their normal.
vec3 material_normal(bool front) {
  const MaterialData m = materials[material_index];
  vec3 n = normalize(in_normal);
  if (m.normal_texture.present != 0u) {
    const vec3 t = normalize(in_tangent.xyz - n * dot(n, in_tangent.xyz) + vec3(1e-12));
    const vec3 b = cross(n, t) * in_tangent.w;
    vec3 read = texel(normal_image, m.normal_texture).xyz * 2.0 - 1.0;
    read.xy *= m.normal_scale;
    n = normalize(t * read.x + b * read.y + n * read.z);
  }
  return front ? n : -n;
}

// x: metallic, y: roughness, z: occlusion.
vec3 material_factors() {
  const MaterialData m = materials[material_index];
  const vec4 read = texel(metallic_roughness_image, m.metallic_roughness_texture);
  const float occlusion = texel(occlusion_image, m.occlusion_texture).r;
  return vec3(m.metallic * read.b, clamp(m.roughness * read.g, 0.045, 1.0), mix(1.0, occlusion, m.occlusion_strength));
}

vec3 material_emission() {
  const MaterialData m = materials[material_index];
  return m.emissive * texel(emissive_image, m.emissive_texture).rgb;
}

#endif
