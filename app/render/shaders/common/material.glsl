// From a material and interpolated vertex attributes to a surface. Textures that a material lacks are bound as white.
// No branch depends on the material's values alone: lavapipe compiles such shaders anew for each draw's values, and in
// Mesa 22.3 keeps the old ones.
// Based on: Khronos, glTF 2.0, 3.9; KHR_texture_transform.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_MATERIAL
#define LAMP_MATERIAL
#extension GL_EXT_scalar_block_layout : require
#include "common/emission.glsl"
#include "scene_data.h"

// A uniform block: helper invocations must read the same texture transform as their neighbours, or derivatives, and with
// them mip levels, go wrong; software devices do not load storage buffers for them.
layout(set = 0, binding = 1, scalar) uniform MaterialBlock { MaterialData material; };
layout(set = 0, binding = 5) uniform sampler2D base_color_image;
layout(set = 0, binding = 6) uniform sampler2D metallic_roughness_image;
layout(set = 0, binding = 7) uniform sampler2D normal_image;
layout(set = 0, binding = 8) uniform sampler2D occlusion_image;
layout(set = 0, binding = 9) uniform sampler2D emissive_image;

layout(location = 0) in vec3 in_normal;
layout(location = 1) in vec4 in_tangent;
layout(location = 2) in vec2 in_uv0;
layout(location = 3) in vec2 in_uv1;
layout(location = 4) in vec4 in_color;

vec4 texel(sampler2D image, TextureData t) {
  const vec2 uv = mix(in_uv0, in_uv1, bvec2(t.uv != 0u));
  return texture(image, vec2(dot(t.u_row, uv), dot(t.v_row, uv)) + t.offset);
}

vec4 material_color() {
  return material.base_color * in_color * texel(base_color_image, material.base_color_texture);
}

bool is_cut_out(float alpha) {
  return alpha < material.alpha_cutoff;
}

// Back faces of double-sided materials turn their normal.
vec3 material_normal(bool front) {
  const vec3 z = normalize(in_normal);
  const vec3 x = normalize(in_tangent.xyz - z * dot(z, in_tangent.xyz) + vec3(1e-12));
  const vec3 y = cross(z, x) * in_tangent.w;
  vec3 read = texel(normal_image, material.normal_texture).xyz * 2.0 - 1.0;
  read.xy *= material.normal_scale;
  const vec3 n = normalize(x * read.x + y * read.y + z * read.z);
  return front ? n : -n;
}

// x: metallic, y: roughness, z: occlusion.
vec3 material_factors() {
  const vec4 read = texel(metallic_roughness_image, material.metallic_roughness_texture);
  const float occlusion = texel(occlusion_image, material.occlusion_texture).r;
  return vec3(material.metallic * read.b, clamp(material.roughness * read.g, 0.045, 1.0), mix(1.0, occlusion, material.occlusion_strength));
}

vec3 material_emission() {
  return kept_emission(material.emissive * texel(emissive_image, material.emissive_texture).rgb);
}

#endif
