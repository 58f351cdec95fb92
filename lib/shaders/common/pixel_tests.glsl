// Pruning by pixel: does a light reach this very pixel? Generous by the rounding of 32-bit arithmetic.
// Based on: Primal engine, Light Culling with Approximate Sphere-Cone Intersection, listing 8.
// Needs: TILE_PX; SHAPES.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_PIXEL_TESTS
#define LAMP_COMMON_PIXEL_TESTS
#include "common/box_tests.glsl"
#include "common/light_bounds.glsl"
#include "common/tile_depth.glsl"

// Cosines of 32 bits tell small angles apart badly; this much covers their rounding.
const float ROUND_COSINE = 5e-7;

struct PrunePixel {
  vec3 position;  // world space
  float z_view;
  float spread_m;  // how far from there the sample may be: one of several lies anywhere in its pixel
  bool covered;    // false: sky, or beyond the picture
};

// Half a pixel's diagonal at a depth.
float half_diagonal(Frame frame, float z_view) {
  const mat4 m = frame.clip_from_view;
  const vec2 side = 2.0 * abs(m[3][3] - m[2][3] * z_view) / (vec2(frame.size_px) * abs(vec2(m[0][0], m[1][1])));
  return 0.5 * length(side);
}

// The pixel of the tile's i-th sample.
PrunePixel prune_pixel(Frame frame, DepthImage depth_image, uvec2 tile, uint i) {
  const uint key = tile_sample_key(frame, depth_image, tile, i);
  if (key == SKY_KEY) return PrunePixel(vec3(0.0), 0.0, 0.0, false);
  const vec2 center = vec2(tile_pixel(depth_image, tile, i)) + 0.5;
  const float z_view = z_view_of_key(frame, key);
  const float spread_m = samples_of(depth_image) > 1u ? half_diagonal(frame, z_view) : 0.0;
  return PrunePixel(world_position(frame, center, z_view), z_view, spread_m, true);
}

float pixel_slack(Frame frame, Light light, PrunePixel pixel) {
  return pixel.spread_m + ROUND_RADIUS * min(light.range, INFINITE_RADIUS) +
         ROUND_POSITION * (length(light.position) + length(pixel.position) + length(frame.eye_world));
}

bool reaches_pixel(Frame frame, uint id, Light light, PrunePixel pixel) {
  const vec3 offset = pixel.position - light.position;
  const float slack = pixel_slack(frame, light, pixel);
  const float reach = light.range + slack;
  const float distance2 = dot(offset, offset);
  if (!(light.range > 0.0) || (light.range < INFINITE_RADIUS && distance2 > reach * reach)) return false;
  if (SHAPES && !box_may_hold(frame, id, light, pixel.position, slack)) return false;
  if (light.type != LIGHT_SPOT) return true;
  const float along = dot(offset, light.direction);
  const float distance = sqrt(distance2);
  return along + 2.0 * slack >= distance * (light.cos_outer - ROUND_COSINE);
}

#endif
