// The bricks that a light may reach: its level, and a box of them; and the light itself, widened by what rounding moves.
// Needs: BRICK_RATIO, a brick's least side over the light's range.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_WORLD_BRICKS
#define LAMP_COMMON_WORLD_BRICKS
#include "common/frame.glsl"
#include "common/world_cells.glsl"
#include "common/world_slack.glsl"
#include "lamplight/shared/light.h"

// Several shaders work these out, each by itself, and count on the same bits: what decides is made of additions,
// multiplications and comparisons alone, in this order, which Vulkan rounds in one way.
struct LightBricks {
  uint level;
  vec3 first;  // brick
  uvec3 size;  // bricks; 0 of a light that reaches nothing
  vec3 center;
  float radius;
};

float square_of(vec3 v) {
  precise const float sum = v.x * v.x + v.y * v.y + v.z * v.z;
  return sum;
}

// The least level whose bricks are not smaller than that.
uint level_of(float side) {
  const uint bits = floatBitsToUint(side * bricks_a_metre(0u));
  const uint rounded_up = (bits + (1u << MANTISSA_BITS) - 1u) >> MANTISSA_BITS;
  return max(rounded_up, EXPONENT_OF_1) - EXPONENT_OF_1;
}

LightBricks bricks_of(Frame frame, LightSphere sphere) {
  LightBricks b;
  b.center = sphere.center;
  precise const float radius = sphere.radius * (1.0 + ROUND_RADIUS) + world_slack(frame, sphere.center);
  b.radius = radius;
  precise const float side = BRICK_RATIO * radius;
  b.level = min(level_of(side), WORLD_EVERYTHING);
  b.first = vec3(0.0);
  b.size = uvec3(sphere.radius < 0.0 ? 0u : 1u);
  if (sphere.radius < 0.0 || b.level == WORLD_EVERYTHING) return b;
  const float scale = bricks_a_metre(b.level);
  precise const vec3 low = (sphere.center - radius) * scale;
  precise const vec3 high = (sphere.center + radius) * scale;
  b.first = floor(low);
  b.size = uvec3(floor(high) - floor(low)) + 1u;
  return b;
}

// The light's brick with that code.
vec3 brick_of_code(LightBricks b, uint code) {
  const uvec3 remainders = uvec3(code, code / MOST_BRICKS_ACROSS, code / (MOST_BRICKS_ACROSS * MOST_BRICKS_ACROSS));
  const uvec3 from_first = remainders + MOST_BRICKS_ACROSS - brick_remainders(b.first);
  return b.first + vec3(from_first % MOST_BRICKS_ACROSS);
}

bool sphere_touches_cube(vec3 center, float radius, vec3 low, float side) {
  precise const vec3 outside = max(max(low - center, center - (low + side)), vec3(0.0));
  precise const float radius2 = radius * radius;
  return square_of(outside) <= radius2;
}

#endif
