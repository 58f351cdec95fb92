// Which of a radial bound's finest bytes points that a block of a map's texels may light lie behind, as seen from the light.
// Based on: Cigolle et al., A Survey of Efficient Representations for Independent Unit Vectors, JCGT 3:2 (2014). In an
// octant the map of (x, y, z) is x / (x + y + z), which grows with x and falls with y and z; so the ends of a block, which
// lies in one octant, give the ends of the map. Taps and the normal offset then move points by an angle.
// SPDX-License-Identifier: Apache-2.0
#ifndef SHADOW_RADIAL_CELLS
#define SHADOW_RADIAL_CELLS
#include "common/radial_areas.glsl"
#include "shadow/parts/radial_reach.glsl"

const float RADIAL_AROUND = 2.4495;  // sqrt(6)

// What taps take for a block, as the light sees it, over depths of 1.
struct RadialBlock {
  vec2 low;  // on the octahedron's square, -1 .. 1
  vec2 high;
  vec2 least;  // of |x| and |y| of directions whose |x| + |y| + |z| is 1
  vec2 most;
  float sum;      // at most |x| + |y| + |z| of those of length 1
  float nearest;  // from the light
  float farthest;
};

// On the square, along one side, when a place on a face moves along both of its sides by 1; `sum`: at most |x| + |y| + |z|,
// of which the face's own is 1. What is x / s there changes by at most (1 + |y|) / s^2 + |x| / s^2 = 1 / s, and what is
// 1 / s by 2 / s^2.
float radial_step(uint square, float sum) { return square / 2u == 2u || sum > 2.0 ? 1.0 / sum : 2.0 / (sum * sum); }

RadialBlock radial_block_of_face(uint light, uint square, vec2 low, vec2 high) {
  const float along = (square & 1u) == 0u ? 1.0 : -1.0;
  const vec2 nearer = min(abs(low), abs(high));
  const vec2 farther = max(abs(low), abs(high));
  const vec3 a = radial_turned(square, vec3(nearer, 1.0));
  const vec3 b = radial_turned(square, vec3(farther, 1.0));
  const vec3 middle = radial_turned(square, vec3(low + high, along));
  const vec2 side = vec2(octahedron_sign(middle.x), octahedron_sign(middle.y));
  precise const vec2 least = a.xy / vec2(a.x + b.y + b.z, b.x + a.y + b.z);
  precise const vec2 most = b.xy / vec2(b.x + a.y + a.z, a.x + b.y + a.z);
  precise const vec2 from = (middle.z < 0.0 ? 1.0 - most.yx : least) * side;
  precise const vec2 to = (middle.z < 0.0 ? 1.0 - least.yx : most) * side;
  const float taps = radial_taps_aside(light);
  const vec2 within = max(nearer - taps, 0.0);
  const float sum = 1.0 + within.x + within.y;
  const float aside = taps * radial_step(square, sum);
  RadialBlock block;
  block.low = min(from, to) - aside;
  block.high = max(from, to) + aside;
  block.least = least - aside;
  block.most = most + aside;
  block.nearest = length(vec3(within, 1.0));
  block.farthest = length(vec3(farther + taps, 1.0));
  block.sum = sum / block.farthest;
  return block;
}

RadialBlock radial_block_of_octahedron(uint light, vec2 low, vec2 high) {
  const vec2 p = 0.5 * (low + high);
  const float taps = radial_taps_aside(light);
  const float aside = 0.5 * (high.x - low.x) + taps;
  const vec3 v = octahedron_point(p);
  RadialBlock block;
  block.low = low - taps;
  block.high = high + taps;
  block.least = abs(v.xy) - aside;
  block.most = abs(v.xy) + aside;
  block.nearest = max(length(v) - RADIAL_AROUND * aside, 0.5773);
  block.farthest = min(length(v) + RADIAL_AROUND * aside, 1.0);
  block.sum = 1.0 / block.farthest;
  return block;
}

// Of points that are no farther than `offset` from the block's.
RadialArea radial_area_of_block(RadialBlock block, float offset) {
  const float sine = offset / block.nearest;
  const RadialArea all = RadialArea(ivec2(0), ivec2(RADIAL_SIDE - 1u));
  if (!(sine < RADIAL_MOST_SINE)) return all;
  precise const float aside = radial_aside(block.least, block.most, block.sum, radial_angle(sine));
  const float half_side = 0.5 * float(RADIAL_SIDE);
  const RadialArea area = radial_area((block.low - aside + 1.0) * half_side, (block.high + aside + 1.0) * half_side);
  const ivec2 count = area.high - area.low + 1;
  return max(count.x, count.y) < int(RADIAL_SIDE) ? area : all;
}

// Of a spot: a box in its own axes; `scale` as in RadialBound.
RadialArea radial_area_of_box(float scale, vec3 low, vec3 high) {
  const RadialArea all = RadialArea(ivec2(0), ivec2(RADIAL_SIDE - 1u));
  if (low.z <= 0.0) return all;
  const float middle = 0.5 * float(RADIAL_SIDE);
  const RadialArea area = radial_area(middle + scale * min(low.xy / low.z, low.xy / high.z),
                                      middle + scale * max(high.xy / low.z, high.xy / high.z));
  return RadialArea(clamp(area.low, all.low, all.high), clamp(area.high, all.low, all.high));
}

// What points that a block may light: the bytes that they lie behind, and how far the farthest is over M's depth.
struct RadialReach {
  RadialArea cells;
  float farthest;
};

RadialReach radial_reach_of(uint light, uint square, vec2 first, float size, float cells_scale) {
  if (shadow_maps[light].kind == SHADOW_SPOT) {
    const RadialBox box = radial_box(light, square, first, size);
    return RadialReach(radial_area_of_box(cells_scale, box.low, box.high), radial_longest(box));
  }
  const float scale = shadow_maps[light].scale;
  const float middle = 0.5 * float(shadow_maps[light].side);
  const vec2 low = (first - middle) / scale;
  const vec2 high = (first + size - middle) / scale;
  RadialBlock block;
  if (shadow_maps[light].kind == SHADOW_OCTAHEDRON) {
    block = radial_block_of_octahedron(light, low, high);
  } else {
    block = radial_block_of_face(light, square, low, high);
  }
  const float offset = radial_offset(light);
  return RadialReach(radial_area_of_block(block, offset), block.farthest + offset);
}

#endif
