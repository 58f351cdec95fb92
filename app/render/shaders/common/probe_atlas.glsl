// What captures of reflection probes say: radiance by direction and roughness, and how far the surfaces are.
// Based on: Karis, Real Shading in Unreal Engine 4, SIGGRAPH course (2013): the split sum.
// Needs: nothing; binding 15.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_PROBE_ATLAS
#define LAMP_PROBE_ATLAS
#include "brdf.glsl"
#include "probe_map.glsl"

// Radiance; alpha: 1 over the distance in m, 0 for the sky. Along a plane that is linear, so it interpolates exactly.
layout(set = 0, binding = 15) uniform sampler2D probe_atlas_image;

vec4 probe_texel(uint slot, vec2 place, uint level) {
  const uvec2 size = uvec2(textureSize(probe_atlas_image, 0));
  const uint columns = size.x / PROBE_BLOCK_WIDTH;
  const uvec2 block = uvec2(slot % columns, slot / columns) * uvec2(PROBE_BLOCK_WIDTH, PROBE_BLOCK_HEIGHT);
  const vec2 origin = vec2(block + probe_level_origin(level));
  precise const vec2 texel = fma(place, vec2(0.5 * float(probe_level_side(level))), vec2(0.5 * float(probe_level_side(level))));
  precise const vec2 uv = (origin + texel) / vec2(size);
  return textureLod(probe_atlas_image, uv, 0.0);
}

// Linear radiance, filtered by GGX of that roughness as seen along its axis. `direction` is in world space.
vec3 probe_radiance(uint slot, vec3 direction, float roughness) {
  const vec2 place = probe_place(direction);
  precise const float level = clamp((roughness - PROBE_SHARP) / PROBE_STEP, 0.0, float(PROBE_LEVELS - 1u));
  const uint first = min(uint(level), PROBE_LEVELS - 2u);
  precise const float share = level - float(first);
  const vec3 sharp = probe_texel(slot, place, first).rgb;
  if (share == 0.0) return sharp;
  const vec3 blunt = probe_texel(slot, place, first + 1u).rgb;
  precise const vec3 mixed = fma(vec3(share), blunt - sharp, sharp);
  return mixed;
}

// Metres from where the probe was captured to the nearest surface; PROBE_SKY_M where there is none.
float probe_distance(uint slot, vec3 direction) {
  const float inverse = probe_texel(slot, probe_place(direction), 0u).a;
  return 1.0 / max(inverse, 1.0 / PROBE_SKY_M);
}

// What a surface reflects of a radiance: F0 times the first and the second.
vec2 split_sum(float n_dot_v, float roughness) {
  precise const float alpha = roughness * roughness;
  return surroundings_split(n_dot_v, alpha, alpha * alpha);
}

#endif
