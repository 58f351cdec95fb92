// A fragment of a light's proxy: sets the light's bit in its tile, if depth allows.
// Based on: Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017), "Conservative Rasterized
// Culling": eye outside: front faces nearer than the surface; eye inside: back faces behind it; and depth bounds.
// Needs: set_bit(word, bit).
// SPDX-License-Identifier: Apache-2.0
#extension GL_EXT_samplerless_texture_functions : require
#include "lamplight/shared/tile.h"
#include "methods/raster_face.glsl"

layout(set = 0, binding = 4) uniform texture2D depth_image;
layout(set = 0, binding = 5, scalar) readonly buffer RangeBuffer { TileRanges ranges[]; };

const float ROUND_DEPTH = 1e-5;  // of a depth: interpolation in 32 bits

// Depths of the surfaces that count: the pixel's, or all of the tile. x > y: none.
vec2 surface_depths(uvec2 pixel, uint tile) {
  if (!EXACT_PIXEL) return vec2(ranges[tile].z_near[0], ranges[tile].z_far[0]);
  const float depth = texelFetch(depth_image, ivec2(pixel), 0).x;
  return depth > 0.0 ? vec2(z_view_of(frame, depth)) : vec2(1.0, -1.0);
}

void main() {
  const vec2 face = face_depths(EXACT_PIXEL ? 0.0 : 0.5);
  const uvec2 pixel = uvec2(gl_FragCoord.xy) * RASTER_PX;
  if (any(greaterThanEqual(pixel, frame.size_px))) return;  // a helper thread
  const uvec2 at = pixel / TILE_PX;
  const uint tile = at.x + (frame.size_px.x + TILE_PX - 1u) / TILE_PX * at.y;
  const vec2 surface = surface_depths(pixel, tile);
  const LightProxy proxy = proxies[in_light];
  bool meets = surface.x <= surface.y && surface.x <= proxy.z_far && surface.y >= proxy.z_near;
  if (INSIDE == PROXIES_OUTSIDE)
    meets = meets && min(face.x, proxy.z_far) <= surface.y + ROUND_DEPTH * abs(surface.y);
  else
    meets = meets && (reaches_everywhere() || max(face.y, proxy.z_near) >= surface.x - ROUND_DEPTH * abs(surface.x));
  if (meets) set_bit(tile * WORDS + in_light / 32u, 1u << (in_light % 32u));
}
