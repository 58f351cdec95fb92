// Filters that compare depths: one texel, or sixteen on a disc that a seed turns.
// Based on: Vogel, A Better Way to Construct the Sunflower Head (1979), for the disc; Ellis, lowbias32, Prospecting for
// Hash Functions (2018).
// SPDX-License-Identifier: Apache-2.0
#ifndef SHADOW_TAPS
#define SHADOW_TAPS
#include "shadow/parts/place.glsl"

// Of a depth: what rasterization and this arithmetic round away. 0.5 mm a metre.
LAMP_CONST_FLOAT SHADOW_ROUNDING = 5e-4;

LAMP_CONST SHADOW_PCF_TAPS = 16u;
// cos and sin of pi (3 - sqrt(5))
LAMP_CONST_FLOAT GOLDEN_COS = -0.73736888;
LAMP_CONST_FLOAT GOLDEN_SIN = 0.67549029;

// 1: nothing is drawn nearer to the light at this texel.
float shadow_is_lit(uint light, ShadowPlace place, ivec2 texel) {
  const float nearest = SHADOW_TEXEL(shadow_atlas, shadow_texel(light, place.square, texel)).x;
  precise const float own = shadow_maps[light].near_m * (1.0 + SHADOW_ROUNDING) / place.w;
  return nearest <= own ? 1.0 : 0.0;
}

ivec2 shadow_texel_of(vec2 place) { return ivec2(int(floor(place.x)), int(floor(place.y))); }

float shadow_hard(uint light, ShadowPlace place) { return shadow_is_lit(light, place, shadow_texel_of(place.texel)); }

uint shadow_mixed(uint x) {
  uint y = x;
  y = (y ^ (y >> 16u)) * 0x7feb352du;
  y = (y ^ (y >> 15u)) * 0x846ca68bu;
  return y ^ (y >> 16u);
}

// A unit vector: a point of the circle by the tangent of half its angle, which takes no function that devices round
// differently.
vec2 shadow_turn(uint seed) {
  const uint bits = shadow_mixed(seed);
  precise const float t = float(bits >> 9u) * (2.0 / 8388608.0) - 1.0;
  precise const float inverse = 1.0 / (1.0 + t * t);
  precise const vec2 half_circle = vec2((1.0 - t * t) * inverse, 2.0 * t * inverse);
  return (bits & 1u) == 0u ? half_circle : -half_circle;
}

// Texels from a place to its farthest tap. Below 64 texels a square has too few for two.
float shadow_pcf_radius(uint light) { return shadow_maps[light].side >= 64u ? 2.0 : 1.0; }

float shadow_pcf(uint light, ShadowPlace place, uint seed) {
  const float radius = shadow_pcf_radius(light);
  vec2 way = shadow_turn(seed);
  float lit = 0.0;
  for (uint i = 0u; i < SHADOW_PCF_TAPS; ++i) {
    precise const float from_middle = radius * sqrt((float(i) + 0.5) / float(SHADOW_PCF_TAPS));
    precise const vec2 at = vec2(LAMP_FMA(way.x, from_middle, place.texel.x), LAMP_FMA(way.y, from_middle, place.texel.y));
    lit += shadow_is_lit(light, place, shadow_texel_of(at));
    precise const vec2 turned = vec2(way.x * GOLDEN_COS - way.y * GOLDEN_SIN, way.x * GOLDEN_SIN + way.y * GOLDEN_COS);
    way = turned;
  }
  return lit / float(SHADOW_PCF_TAPS);
}

#endif
