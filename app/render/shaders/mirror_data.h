// What mirrored rays leave from pass to pass, and what they read of materials.
// Promise: scalar layout, the same bytes in C++ and in GLSL.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_MIRROR_DATA_H
#define LAMP_MIRROR_DATA_H

#include "scene_data.h"

#ifdef __cplusplus
namespace lamp::app::gpu {
using namespace lamp::shared;
#endif

// In place of a hit's triangle.
LAMP_CONST MIRROR_NO_RAY = 0xffffffffu;  // the pixel mirrors nothing
LAMP_CONST MIRROR_SKY = 0xfffffffeu;     // its ray meets nothing
LAMP_CONST MIRROR_ENDED = 0xfffffffdu;   // the device ended the search: what the ray meets is not known

// What a pixel's ray meets.
struct MirrorHit {
  uint triangle;  // of the hierarchy, or one of the above
  uint instance;  // likewise
  float u;        // weights of the second and the third corner
  float v;
};

// A ray, for who checks what it meets.
struct MirrorAsked {
  vec3 origin;     // world, m
  vec3 direction;  // unit
};

// The surface there.
struct MirrorSurface {
  vec3 position;    // world, m
  uint normal;      // as in the G-buffer: octahedral,
  uint factors;     // metallic, roughness, occlusion,
  uint base_color;  // and sRGB
  uvec2 emission;   // three halves
};

// Counted in a frame.
struct MirrorCounts {
  uint rays;
  uint hits;
  uint ended;
};

// An image that hits read: its levels lie one behind the other among the texels, each half as wide and high.
struct MirrorImage {
  uint first;  // texel
  uint width;
  uint height;
  uint levels;
  uint is_srgb;
};

LAMP_CONST MIRROR_NO_IMAGE = 0xffffffffu;
LAMP_CONST MIRROR_WRAP_REPEAT = 0u;
LAMP_CONST MIRROR_WRAP_MIRROR = 1u;
LAMP_CONST MIRROR_WRAP_CLAMP = 2u;

// How a material uses one.
struct MirrorTexture {
  TextureData place;
  uint image;  // or MIRROR_NO_IMAGE: white
  uint wrap_u;
  uint wrap_v;
};

struct MirrorMaterial {
  MaterialData factors;
  MirrorTexture base_color;
  MirrorTexture metallic_roughness;
  MirrorTexture normal;
  MirrorTexture occlusion;
  MirrorTexture emissive;
};

// Push constants of all passes.
struct MirrorPush {
  float roughness;  // from which on surfaces mirror nothing
  uint root;        // of the hierarchy
  uint two;         // for loops_ended
};

#ifdef __cplusplus
static_assert(sizeof(MirrorHit) == 16 && sizeof(MirrorSurface) == 32);
}  // namespace lamp::app::gpu
#endif

#endif
