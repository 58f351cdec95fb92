// Pruning by pixel: does a light reach this very pixel? Generous by the rounding of 32-bit arithmetic.
// Based on: Primal engine, Light Culling with Approximate Sphere-Cone Intersection, listing 8.
// Needs: TILE_PX.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_PIXEL_TESTS
#define LAMP_COMMON_PIXEL_TESTS
#include "common/light_bounds.glsl"
#include "common/tile_depth.glsl"

// Cosines of 32 bits tell small angles apart badly; this much covers their rounding.
const float ROUND_COSINE = 5e-7;

struct PrunePixel {
  vec3 position;  // world space
  float z_view;
  bool covered;  // false: sky, or beyond the picture
};

// The tile's i-th pixel.
PrunePixel prune_pixel(Frame frame, texture2D depth_image, uvec2 tile, uint i) {
  const float depth = tile_pixel_depth(frame, depth_image, tile, i);
  if (depth <= 0.0) return PrunePixel(vec3(0.0), 0.0, false);
  const uvec2 pixel = tile * TILE_PX + uvec2(i % TILE_PX, i / TILE_PX);
  const float z_view = z_view_of(frame, depth);
  return PrunePixel(world_position(frame, vec2(pixel) + 0.5, z_view), z_view, true);
}

bool reaches_pixel(Frame frame, Light light, PrunePixel pixel) {
  const vec3 offset = pixel.position - light.position;
  const float slack = ROUND_RADIUS * min(light.range, INFINITE_RADIUS) +
                      ROUND_POSITION * (length(light.position) + length(pixel.position) + length(frame.eye_world));
  const float reach = light.range + slack;
  const float distance2 = dot(offset, offset);
  if (!(light.range > 0.0) || (light.range < INFINITE_RADIUS && distance2 > reach * reach)) return false;
  if (light.type != LIGHT_SPOT) return true;
  const float along = dot(offset, light.direction);
  const float distance = sqrt(distance2);
  return along + 2.0 * slack >= distance * (light.cos_outer - ROUND_COSINE);
}

#endif
