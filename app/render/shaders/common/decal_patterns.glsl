// What decals show: patterns computed from the place on the decal, with edges as soft as a pixel is wide.
// Based on: value noise with integer hashes: Jarzynski, Olano, Hash Functions for GPU Rendering, JCGT 9:3 (2020).
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_DECAL_PATTERNS
#define LAMP_DECAL_PATTERNS
#include "decal_data.h"

const float TURN = 6.28318531;

struct Paint {
  vec3 color;
  float alpha;
  float height;  // 0 .. 1, of the relief
};

// 0 .. 1; permuted congruential generator.
float hash_unit(ivec2 cell, uint seed) {
  uint h = uint(cell.x) * 747796405u + uint(cell.y) * 2891336453u + seed * 277803737u;
  h = ((h >> ((h >> 28) + 4u)) ^ h) * 277803737u;
  h = ((h >> 22) ^ h) * 747796405u;
  return float((h ^ (h >> 16)) >> 8) / 16777216.0;
}

float value_noise(vec2 p, uint seed) {
  const vec2 cell = floor(p);
  precise const vec2 f = p - cell;
  precise const vec2 t = f * f * (3.0 - 2.0 * f);
  const ivec2 c = ivec2(cell);
  precise const float low = mix(hash_unit(c, seed), hash_unit(c + ivec2(1, 0), seed), t.x);
  precise const float high = mix(hash_unit(c + ivec2(0, 1), seed), hash_unit(c + ivec2(1, 1), seed), t.x);
  precise const float value = mix(low, high, t.y);
  return value;
}

float fractal_noise(vec2 p, uint seed) {
  precise float sum = 0.0;
  precise float share = 0.5;
  for (uint octave = 0u; octave < 4u; ++octave) {
    sum += share * value_noise(p, seed + octave);
    p *= 2.0;
    share *= 0.5;
  }
  return sum / 0.9375;
}

// 1 where x is below 0, 0 above, over a ramp of `soft`.
float below(float x, float soft) {
  precise const float t = 0.5 - x / max(soft, 1e-5);
  return clamp(t, 0.0, 1.0);
}

Paint mosaic(DecalData d, vec2 uv, float soft) {
  const float RINGS = 11.0;
  precise const float r = length(uv);
  precise const float around = atan(uv.y, uv.x) / TURN + 0.5;
  precise const float ring = min(floor(r * RINGS), RINGS - 1.0);
  const float stones = max(round(TURN * (ring + 0.5)), 1.0);
  precise const vec2 place = vec2(r * RINGS - ring, fract(around * stones));
  const vec2 to_joint = min(place, 1.0 - place);
  precise const float joint = below(min(to_joint.x, to_joint.y) - 0.07, soft * RINGS + 0.02);
  const ivec2 stone = ivec2(int(ring), int(floor(around * stones)));
  // One colour a stone: that of its middle.
  precise const float angle = (float(stone.y) + 0.5) / stones * TURN;
  precise const float middle = (ring + 0.5) / RINGS;
  precise const float star = middle * (1.0 + 0.24 * cos(8.0 * angle));
  vec3 color = mix(d.color_a, d.color_b, 0.5) * 1.3 + 0.12;
  if (star < 0.36) color = d.color_a;
  if (star >= 0.36 && star < 0.56) color = d.color_b;
  if (ring >= RINGS - 2.0) color = (stone.y & 1) == 0 ? d.color_a : d.color_b;
  color *= 0.75 + 0.5 * hash_unit(stone, d.seed);
  return Paint(mix(color, vec3(0.11, 0.1, 0.09), joint), below(r - 0.985, soft), 1.0 - joint);
}

Paint painting(DecalData d, vec2 uv, float soft) {
  precise const float edge = max(abs(uv.x), abs(uv.y));
  precise const float hill = -0.15 + 0.16 * sin(uv.x * 3.1 + float(d.seed % 7u)) + 0.05 * sin(uv.x * 9.0);
  precise const float near_hill = -0.45 + 0.12 * sin(uv.x * 4.3 + float(d.seed % 5u) * 1.7);
  const vec3 haze = vec3(0.62, 0.5, 0.33);
  vec3 color = mix(haze, d.color_a, clamp(uv.y * 0.6 + 0.4, 0.0, 1.0));
  color = mix(color, vec3(0.72, 0.26, 0.07), below(length(uv - vec2(0.34, 0.3)) - 0.2, soft));
  color = mix(color, mix(d.color_b, haze, 0.35), below(uv.y - hill, soft));
  color = mix(color, d.color_b * 0.6, below(uv.y - near_hill, soft));
  precise const float trunk = fract(uv.x * 3.5 + 0.2) - 0.5;
  const bool tree = (int(floor(uv.x * 3.5 + 0.2)) + int(d.seed)) % 3 != 0;
  precise const float cypress = length(vec2(trunk * 1.6, (uv.y - near_hill - 0.16) * 0.85)) - 0.2;
  if (tree) color = mix(color, vec3(0.03, 0.07, 0.03), below(cypress, soft));
  color = mix(d.color_b * 0.8 + vec3(0.05, 0.03, 0.0), color, below(edge - 0.88, soft));
  color = mix(color, vec3(0.5, 0.37, 0.14), below(abs(edge - 0.86) - 0.022, soft));
  const float plaster = fractal_noise(uv * 5.0, d.seed);
  precise const float worn = plaster + 1.15 - edge;  // flakes off from the edges
  return Paint(color * (0.7 + 0.5 * plaster), below(0.52 - worn, 0.1 + soft), plaster);
}

// A jagged line from (0, 0) along x; distances in shares of the half extents.
float crack_line(vec2 p, float wide, uint seed, float soft) {
  precise const float bend = 0.5 * (fractal_noise(vec2(p.x * 2.2, 0.5), seed) - 0.5) + 0.05 * (value_noise(vec2(p.x * 23.0, 0.5), seed) - 0.5);
  precise const float width = wide * (0.35 + value_noise(vec2(p.x * 9.0, 3.5), seed));
  return below(abs(p.y - bend) - width, soft + 0.01);
}

Paint crack(DecalData d, vec2 uv, float soft) {
  precise const float taper = clamp(1.0 - abs(uv.x), 0.0, 1.0);
  precise float line = crack_line(uv, 0.035 * taper, d.seed, soft) * below(-taper, 0.05);
  for (uint branch = 0u; branch < 3u; ++branch) {
    const float from = -0.7 + 0.5 * float(branch);
    const float side = (d.seed + branch) % 2u == 0u ? 1.0 : -1.0;
    precise const vec2 p = vec2(uv.x - from, (uv.y - side * 0.55 * (uv.x - from)) * 1.2);
    precise const float along = clamp(1.0 - p.x / 0.6, 0.0, 1.0);
    if (p.x > 0.0 && along > 0.0) line = max(line, crack_line(p, 0.02 * along, d.seed, soft));
  }
  return Paint(d.color_a, line, 1.0 - line);
}

Paint moss(DecalData d, vec2 uv, float soft) {
  const float large = fractal_noise(uv * 2.5, d.seed);
  const float small = fractal_noise(uv * 14.0, d.seed + 9u);
  precise const float cover = large + 0.25 * small - 0.75 * dot(uv, uv);
  return Paint(mix(d.color_a, d.color_b, small), below(0.36 - cover, 0.08 + soft) * below(length(uv) - 0.95, 0.1), small);
}

Paint sign_plate(DecalData d, vec2 uv, float soft) {
  const vec2 corner = max(abs(uv) - 0.8, 0.0);
  precise const float edge = length(corner) - 0.17;
  precise const float shaft = max(abs(uv.x + 0.12) - 0.42, abs(uv.y) - 0.13);
  precise const float head = max(0.1 - uv.x, (uv.x - 0.68) * 0.7 + abs(uv.y));
  const float ink = max(below(min(shaft, head), soft), below(abs(edge + 0.09) - 0.035, soft));
  const float plate = below(edge, soft);
  return Paint(mix(d.color_a, d.color_b, ink), plate, plate);
}

// `p`: metres from the decal's middle; `soft`: metres that a pixel is wide.
Paint paint_of(DecalData d, vec2 p, float soft_m) {
  precise const vec2 uv = p / d.box.half_extents.xy;
  const float soft = soft_m / min(d.box.half_extents.x, d.box.half_extents.y);
  if (d.pattern == DECAL_MOSAIC) return mosaic(d, uv, soft);
  if (d.pattern == DECAL_PAINTING) return painting(d, uv, soft);
  if (d.pattern == DECAL_CRACK) return crack(d, uv, soft);
  if (d.pattern == DECAL_MOSS) return moss(d, uv, soft);
  if (d.pattern == DECAL_SIGN) return sign_plate(d, uv, soft);
  return Paint(d.color_a, 1.0, 0.0);
}

#endif
