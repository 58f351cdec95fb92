// Pruning by pixel: does a light reach this very pixel? Generous by the rounding of 32-bit arithmetic.
// Based on: Primal engine, Light Culling with Approximate Sphere-Cone Intersection, listing 8.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_TILE_PRUNE
#define LAMP_METHODS_TILE_PRUNE
#include "methods/tile_inputs.glsl"

// Cosines of 32 bits tell small angles apart badly; this much covers their rounding.
const float ROUND_COSINE = 5e-7;

// The tile's i-th pixel in world space; w: z_view, or a negative number for sky and beyond the picture.
struct PrunePixel {
  vec3 position;
  float z_view;
  bool covered;
};

PrunePixel prune_pixel(uvec2 tile, uint i) {
  const float depth = tile_pixel_depth(cull_frame, cull_depth, tile, i);
  if (depth <= 0.0) return PrunePixel(vec3(0.0), 0.0, false);
  const uvec2 pixel = tile * TILE_PX + uvec2(i % TILE_PX, i / TILE_PX);
  const float z_view = z_view_of(cull_frame, depth);
  return PrunePixel(world_position(cull_frame, vec2(pixel) + 0.5, z_view), z_view, true);
}

bool reaches_pixel(Light light, PrunePixel pixel) {
  const vec3 offset = pixel.position - light.position;
  const float slack = ROUND_RADIUS * min(light.range, INFINITE_RADIUS) +
                      ROUND_POSITION * (length(light.position) + length(pixel.position) + length(cull_frame.eye_world));
  const float reach = min(light.range, INFINITE_RADIUS) + slack;
  const float distance2 = dot(offset, offset);
  if (!(light.range > 0.0) || distance2 > reach * reach) return false;
  if (light.type != LIGHT_SPOT) return true;
  const float along = dot(offset, light.direction);
  const float distance = sqrt(distance2);
  return along + slack >= distance * (light.cos_outer - ROUND_COSINE) - slack;
}

// Pixels of a tile with two ranges belong to one of them.
uint range_of_pixel(PrunePixel pixel, TileRanges ranges) { return RANGES == 2u && pixel.z_view > ranges.split ? 1u : 0u; }

#endif
