// Which points a block of a map's texels may light: all that matters for a radial bound.
// A point P is moved by h along its normal to M, whose place and taps around it are looked up. So M lies in the block,
// widened by the taps, and P within h of M. With m0 = (taps + reach) step / scale of offset.glsl, the sine at most 1 and
// grazing at most 2, h <= 2 m0 w of P's depth w; and since sine times cosine is at most 1/2 (and 0.3 for small sines),
// M's depth is at least w - h |cos| L >= w (1 - m0 L): L is by how much depth may grow along one metre, 1 or, in an
// octahedron, sqrt(3). Over M's depth, h is at most 2 m0 / (1 - m0 L).
// SPDX-License-Identifier: Apache-2.0
#ifndef SHADOW_RADIAL_REACH
#define SHADOW_RADIAL_REACH
#include "shadow/parts/blur_step.glsl"
#include "shadow/parts/moments.glsl"
#include "shadow/parts/offset.glsl"
#include "shadow/parts/taps.glsl"

LAMP_CONST_FLOAT RADIAL_UNBOUNDED = 3e38;
const int RADIAL_BATCH = 8;  // texels
// Texels: where rounding may take a place.
LAMP_CONST_FLOAT RADIAL_PLACE_ROUNDING = 0.02;
// Half of sqrt(5) + 1: the most that mean + 2 deviations of values 0 .. 1 comes to, beyond which SHADOW_BLEED of 1/5
// leaves nothing.
LAMP_CONST_FLOAT RADIAL_CHEBYSHEV = 1.6180340;
// Of warped depths: ln(1.618) / (2 EVSM_FAR), of 0 .. 1, and somewhat more for what moments round away.
LAMP_CONST_FLOAT RADIAL_WARPED = 0.0065;
// Of 0 .. 1: two of vsm's least deviations, and what moments round away.
LAMP_CONST_FLOAT RADIAL_VARIANCE = 0.0025;

// Over depths of 1: relative positions of points that the block may light.
struct RadialBox {
  vec3 low;
  vec3 high;
};

bool radial_has_moments() { return SHADOW_FILTER == SHADOW_VSM || SHADOW_FILTER == SHADOW_EVSM; }

// Texels from a place that the normal offset takes into account, as in shadow_of.
float radial_offset_taps(uint light) {
  return SHADOW_FILTER == SHADOW_PCF ? shadow_pcf_radius(light) : radial_has_moments() ? 1.0 : 0.0;
}

// Texels from a place to the farthest texel that has a say.
float radial_taps(uint light) {
  if (radial_has_moments()) return 1.0 + 4.0 * float(blur_step(int(shadow_maps[light].side)));
  return radial_offset_taps(light);
}

// The same over depths of 1, and somewhat more: where rounding may take a place.
float radial_taps_aside(uint light) {
  return (radial_taps(light) + RADIAL_PLACE_ROUNDING) / shadow_maps[light].scale;
}

// h over M's depth; negative: without bound.
float radial_offset(uint light) {
  const float folded = shadow_fold(light);
  const float m = (radial_offset_taps(light) + SHADOW_TEXEL_REACH) * folded / shadow_maps[light].scale;
  return m * folded < 0.9 ? SHADOW_MOST_GRAZING * m / (1.0 - m * folded) : -1.0;
}

// Whether it is worth a look at all: lights that reach everything have no unit, and tiny squares know too little.
bool radial_is_bounded(uint light) {
  const float range = shadow_maps[light].range_m;
  return range > 0.0 && range < 1e18 && radial_offset(light) >= 0.0;
}

// Of what a texel stores, near / w; infinite where nothing was drawn.
float radial_depth_of(uint light, float stored) {
  return stored > 0.0 ? shadow_maps[light].near_m / stored : RADIAL_UNBOUNDED;
}

// The nearest of what a column of texels stores; all of a batch are asked for before the first is waited for.
float radial_least_of_column(ShadowSquare square, ivec2 first, int size) {
  float least = 1.0;
  for (int y = 0; y < size; y += RADIAL_BATCH) {
    float stored[RADIAL_BATCH];
    [[unroll]] for (int i = 0; i < RADIAL_BATCH; ++i) {
      stored[i] = 1.0;
      if (y + i < size) stored[i] = SHADOW_TEXEL(shadow_atlas, square.corner + first + ivec2(0, y + i)).x;
    }
    [[unroll]] for (int i = 0; i < RADIAL_BATCH; ++i) least = min(least, stored[i]);
  }
  return max(least, 0.0);
}

// The depth up to which a texel of that depth may light M.
float radial_farthest_lit(uint light, float w) {
  if (!(w < RADIAL_UNBOUNDED)) return RADIAL_UNBOUNDED;
  if (!radial_has_moments()) return w * (1.0 + 2.0 * SHADOW_ROUNDING);
  const float longest = shadow_longest(light);
  const float share = w / longest;
  const float lit = SHADOW_FILTER == SHADOW_EVSM ? share + RADIAL_WARPED : share * RADIAL_CHEBYSHEV + RADIAL_VARIANCE;
  return lit < 0.99 ? lit * longest : RADIAL_UNBOUNDED;  // depths are cut off at 1
}

// Coordinates of a face as those of the world: its axis is the third.
vec3 radial_turned(uint square, vec3 v) { return square / 2u == 0u ? v.zxy : square / 2u == 1u ? v.yzx : v; }

RadialBox radial_box_around(vec3 low, vec3 high, float offset) { return RadialBox(low - offset, high + offset); }

RadialBox radial_box(uint light, uint square, vec2 first, float size) {
  const float scale = shadow_maps[light].scale;
  const float middle = 0.5 * float(shadow_maps[light].side);
  const float taps = radial_taps_aside(light);
  const float offset = radial_offset(light);
  const vec2 low = (first - middle) / scale - taps;
  const vec2 high = (first + size - middle) / scale + taps;
  if (shadow_maps[light].kind == SHADOW_OCTAHEDRON) {
    const vec3 v = octahedron_point(0.5 * (low + high));
    const float aside = 0.5 * (high.x - low.x);
    const vec3 around = vec3(aside, aside, 2.0 * aside);
    return radial_box_around(v - around, v + around, offset);
  }
  if (shadow_maps[light].kind == SHADOW_SPOT) return radial_box_around(vec3(low, 1.0), vec3(high, 1.0), offset);
  const float along = (square & 1u) == 0u ? 1.0 : -1.0;
  return radial_box_around(radial_turned(square, vec3(low, along)), radial_turned(square, vec3(high, along)), offset);
}

// From the light, over M's depth, to the farthest of the points.
float radial_longest(RadialBox box) { return length(max(abs(box.low), abs(box.high))); }

#endif
