// Filters that read moments of depth, blurred beforehand: variance shadow maps, and exponential ones.
// Based on: Donnelly, Lauritzen, Variance Shadow Maps, I3D (2006); Lauritzen, Summed-Area Variance Shadow Maps, GPU Gems 3
// (2007), chapter 8, for the cut of light that bleeds; Lauritzen, McCool, Layered Variance Shadow Maps, GI (2008), for
// exponential warps.
// SPDX-License-Identifier: Apache-2.0
#ifndef SHADOW_MOMENTS
#define SHADOW_MOMENTS
#include "shadow/parts/place.glsl"

// exp(2 * 40) is the largest square that a float holds with room for sums.
LAMP_CONST_FLOAT EVSM_FAR = 40.0;   // exponent of the warp that keeps what lies behind apart
// And of the one that keeps what lies before apart. A larger one counts casters behind the nearest as lit, and darkens
// surfaces that slant: in docs/methods/shadow-filters.md's corridor and atrium 20 .. 40 leak more and err more, 2 leaks more.
LAMP_CONST_FLOAT EVSM_NEAR = 5.0;
// Of depths 0 .. 1: below it a float's square has no digits left.
LAMP_CONST_FLOAT VSM_LEAST_VARIANCE = 4e-7;
// Of warped depths, relative: the same, and a curved warp over a flat surface.
LAMP_CONST_FLOAT EVSM_LEAST_DEVIATION = 2e-3;
// Light that Chebyshev's bound leaves where two casters lie one behind the other. All below is darkness.
LAMP_CONST_FLOAT SHADOW_BLEED = 0.2;
// m, of lights that reach everything: half of 0 .. 1 is nearer.
LAMP_CONST_FLOAT SHADOW_MIDDLE_M = 10.0;

// m, the depth of what is as far away as the light's range, at most.
float shadow_longest(uint light) {
  const float range = shadow_maps[light].range_m;
  return shadow_maps[light].kind == SHADOW_OCTAHEDRON ? range * 1.7320508 : range;
}

// Depth as 0 .. 1, linear within the light's range. Of nothing (near / w = 0) it is 1.
float shadow_unit_depth(uint light, float w) {
  const float longest = shadow_longest(light);
  precise const float share = longest < 1e18 ? w / longest : w / (w + SHADOW_MIDDLE_M);
  return clamp(share, 0.0, 1.0);
}

// What the atlas stores, near / w, as the same: near / (per_stored * stored + more).
struct ShadowDepths {
  float near_m;
  float per_stored;  // m
  float more;        // m
};

ShadowDepths shadow_depths(uint light) {
  const float longest = shadow_longest(light);
  ShadowDepths depths;
  depths.near_m = shadow_maps[light].near_m;
  depths.per_stored = longest < 1e18 ? longest : SHADOW_MIDDLE_M;
  depths.more = longest < 1e18 ? 0.0 : depths.near_m;
  return depths;
}

float shadow_unit_depth_of_stored(ShadowDepths depths, float stored) {
  if (!(stored > 0.0)) return 1.0;
  precise const float share = depths.near_m / LAMP_FMA(depths.per_stored, stored, depths.more);
  return clamp(share, 0.0, 1.0);
}

// -1 .. 1
vec2 shadow_warped(float unit_depth) {
  precise const float x = unit_depth * 2.0 - 1.0;
  precise const vec2 exponents = vec2(EVSM_FAR * x, -EVSM_NEAR * x);
  return vec2(exp(exponents.x), -exp(exponents.y));
}

vec4 shadow_moments_of_warped(vec2 warped) {
  precise const vec2 squares = warped * warped;
  return vec4(warped.x, squares.x, warped.y, squares.y);
}

vec4 shadow_moments_of_depth(float unit_depth) {
  if (SHADOW_FILTER == SHADOW_EVSM) return shadow_moments_of_warped(shadow_warped(unit_depth));
  precise const float square = unit_depth * unit_depth;
  return vec4(unit_depth, square, 0.0, 0.0);
}

// The largest share of depths with these moments that is not before `depth`, less what bleeds.
float shadow_chebyshev(vec2 moments, float depth, float least_variance) {
  precise const float beyond = depth - moments.x;
  precise const float variance = max(moments.y - moments.x * moments.x, least_variance);
  precise const float share = variance / (variance + beyond * beyond);
  precise const float lit = clamp((share - SHADOW_BLEED) / (1.0 - SHADOW_BLEED), 0.0, 1.0);
  return beyond <= 0.0 ? 1.0 : lit;
}

// Between the four texels around a place.
vec4 shadow_moments_at(uint light, ShadowPlace place) {
  precise const vec2 corner = place.texel - 0.5;
  const ivec2 low = ivec2(int(floor(corner.x)), int(floor(corner.y)));
  precise const vec2 between = corner - vec2(float(low.x), float(low.y));
  const vec4 a = SHADOW_TEXEL(shadow_moments, shadow_texel(light, place.square, low));
  const vec4 b = SHADOW_TEXEL(shadow_moments, shadow_texel(light, place.square, low + ivec2(1, 0)));
  const vec4 c = SHADOW_TEXEL(shadow_moments, shadow_texel(light, place.square, low + ivec2(0, 1)));
  const vec4 d = SHADOW_TEXEL(shadow_moments, shadow_texel(light, place.square, low + ivec2(1, 1)));
  precise const vec4 top = a * (1.0 - between.x) + b * between.x;
  precise const vec4 bottom = c * (1.0 - between.x) + d * between.x;
  precise const vec4 sum = top * (1.0 - between.y) + bottom * between.y;
  return sum;
}

float shadow_vsm(uint light, ShadowPlace place) {
  const vec4 moments = shadow_moments_at(light, place);
  return shadow_chebyshev(moments.xy, shadow_unit_depth(light, place.w), VSM_LEAST_VARIANCE);
}

float shadow_evsm(uint light, ShadowPlace place) {
  const vec4 moments = shadow_moments_at(light, place);
  const vec2 warped = shadow_warped(shadow_unit_depth(light, place.w));
  precise const vec2 least = vec2(EVSM_LEAST_DEVIATION * EVSM_FAR * warped.x, EVSM_LEAST_DEVIATION * EVSM_NEAR * warped.y);
  const float by_far = shadow_chebyshev(moments.xy, warped.x, least.x * least.x);
  const float by_near = shadow_chebyshev(moments.zw, warped.y, least.y * least.y);
  return min(by_far, by_near);
}

#endif
