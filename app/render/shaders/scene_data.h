// What shading reads besides frame and lights: materials, instances, ambient and directional light.
// Promise: scalar layout, the same bytes in C++ and in GLSL.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_SCENE_DATA_H
#define LAMP_SCENE_DATA_H

#include "lamplight/shared/glsl.h"
#include "sky_cell.h"

#ifdef __cplusplus
namespace lamp::app::gpu {
using namespace lamp::shared;
#endif

// A texture of a material: (u', v') = (dot(u_row, uv), dot(v_row, uv)) + offset.
struct TextureData {
  vec2 u_row;
  vec2 v_row;
  vec2 offset;
  uint uv;  // which set, 0 or 1
};

struct MaterialData {
  vec4 base_color;  // linear
  vec3 emissive;    // radiance
  float metallic;
  float roughness;
  float normal_scale;  // 0 without a normal texture
  float occlusion_strength;
  float alpha_cutoff;  // 0 unless masked
  float least_alpha;   // 0 if blended, else 1
  TextureData base_color_texture;
  TextureData metallic_roughness_texture;
  TextureData normal_texture;
  TextureData occlusion_texture;
  TextureData emissive_texture;
};

struct InstanceData {
  mat4 world_from_object;
  vec3 normal_x;  // columns of the normal matrix
  vec3 normal_y;
  vec3 normal_z;
  uint first_triangle;  // its first triangle's number, less the mesh's vertex offset (number_triangles.h)
};

struct DirectionalData {
  vec3 direction;    // unit, the way the light travels
  vec3 illuminance;  // lux times colour
};

// Followed in its buffer by directional_count of DirectionalData.
struct Surroundings {
  vec3 ambient;  // irradiance from everywhere
  vec3 sky;      // radiance of pixels that nothing covers
  uint directional_count;
};

// What the visit shader met at a pixel.
struct Met {
  uint visited;    // lights walked
  uint cell;       // of the look-up; SKY_CELL for sky
  uint in_order;   // of the truth's lights, so many from the first on, one after the other
  uint unordered;  // 1: a light did not ascend
  uint ended;      // 1: the device ended the walk, and there may be more lights
  uint hash;       // of the lights walked, in their order
};

#ifdef __cplusplus
}  // namespace lamp::app::gpu
#endif

#endif
