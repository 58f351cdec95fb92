// A fragment of a light's proxy: sets the light's bit in its tile, if depth allows.
// Based on: Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017), "Conservative Rasterized
// Culling": eye outside: front faces nearer than the surface; eye inside: back faces behind it; and depth bounds. In two
// passes, eye outside: front faces set a stencil bit, then back faces behind the surface set the tile's where it is set.
// Needs: set_bit(word, bit).
// SPDX-License-Identifier: Apache-2.0
#include "common/depth_image.glsl"
#include "common/tile_volume.glsl"
#include "lamplight/shared/tile.h"
#include "methods/raster_face.glsl"

layout(set = 0, binding = 5) uniform DepthImage depth_image;
layout(set = 0, binding = 6, scalar) readonly buffer RangeBuffer { TileRanges ranges[]; };

layout(set = 0, binding = 8, scalar) readonly buffer StencilBuffer { uint stencil[]; };  // read by back faces of two

layout(constant_id = 7) const uint STEP = 0;  // TILES_ONE_PASS, TILES_STENCIL or TILES_BEHIND
layout(constant_id = 8) const bool DEPTH_BOUNDS = true;

layout(constant_id = 9) const uint FURTHER = 0;  // FURTHER_*
#define RADIAL_BINDING 9
#include "methods/raster_further.glsl"

const float ROUND_DEPTH = 1e-5;  // of a depth: interpolation in 32 bits

// Depths of the surfaces that count: the pixel's, or all of the tile. x > y: none.
vec2 surface_depths(uvec2 pixel, uint tile) {
  if (!EXACT_PIXEL) return vec2(ranges[tile].z_near[0], ranges[tile].z_far[0]);
  const uint key = depth_key_at(frame, depth_image, pixel, 0u);
  return key != SKY_KEY ? vec2(z_view_of_key(frame, key)) : vec2(1.0, -1.0);
}

// The further tests between the depths, of the pixel or of all the tile.
bool passes_between(uvec2 pixel, vec2 depths) {
  if (FURTHER == 0u) return true;
  const uint side = EXACT_PIXEL ? 1u : TILE_PX;
  const uvec2 first = pixel / side * side;
  vec4 x_edges;
  vec4 y_edges;
  tile_edges(frame, vec2(first), vec2(first + side), x_edges, y_edges);
  return passes_in_proxy(x_edges, y_edges, depths);
}

void main() {
  const vec2 face = face_depths(EXACT_PIXEL ? 0.0 : 0.5);
  const uvec2 pixel = uvec2(gl_FragCoord.xy) * RASTER_PX;
  if (any(greaterThanEqual(pixel, frame.size_px))) return;  // a helper thread
  const uvec2 at = pixel / TILE_PX;
  const uint tile = at.x + squares_across(frame, TILE_PX).x * at.y;
  const vec2 surface = surface_depths(pixel, tile);
  const LightProxy proxy = proxies[in_light];
  const uint word = tile * WORDS + in_light / 32u;
  const uint bit = 1u << (in_light % 32u);
  bool meets = surface.x <= surface.y;
  if (DEPTH_BOUNDS) meets = meets && surface.x <= proxy.z_far && surface.y >= proxy.z_near;
  if (!INSIDE && STEP != TILES_BEHIND)
    meets = meets && min(face.x, proxy.z_far) <= surface.y + ROUND_DEPTH * abs(surface.y);
  else
    meets = meets && (reaches_everywhere() || max(face.y, proxy.z_near) >= surface.x - ROUND_DEPTH * abs(surface.x));
  if (STEP == TILES_BEHIND) meets = meets && (stencil[word] & bit) != 0u;
  meets = meets && passes_between(pixel, vec2(max(surface.x, proxy.z_near), min(surface.y, proxy.z_far)));
  if (meets) set_bit(word, bit);
}
