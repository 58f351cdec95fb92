// A fragment of a light's proxy: sets the light's bit in clusters of its tile.
// Based on: Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017), "Cluster Rasterizer".
// Promise: the bits of a tile reach from the nearest front to the farthest back without a gap. A walk looks for the
// farthest mark of its tile first, because marks may have gaps where a sliver of the back lies between two pixels.
// Needs: set_bit(word, bit).
// SPDX-License-Identifier: Apache-2.0
#include "methods/raster_face.glsl"

layout(constant_id = 6) const uint MODE = 0;
layout(constant_id = 7) const uint SLICES = 32;
layout(constant_id = 8) const uint SLICE_SCALE = 0;
layout(constant_id = 9) const uint NEAR_MM = 500;
layout(constant_id = 10) const uint FAR_M = 500;
#include "common/slices.glsl"

uint cluster_word(uvec2 tile, uint slice) {
  const uvec2 tiles = (frame.size_px + TILE_PX - 1u) / TILE_PX;
  return (tile.x + tiles.x * (tile.y + tiles.y * slice)) * WORDS + in_light / 32u;
}

// The farthest slice of the tile, up to `last`, that holds the bit; `last` if none does: then the back was too thin for
// any pixel. Other walks set bits meanwhile, but none beyond the farthest mark.
uint farthest_mark(uvec2 tile, uint bit, uint first, uint last) {
  for (uint slice = last + 1u; slice > first; --slice)
    if ((bits[cluster_word(tile, slice - 1u)] & bit) != 0u) return slice - 1u;
  return last;
}

void main() {
  const vec2 face = face_depths(1.0);
  const uvec2 pixel = uvec2(gl_FragCoord.xy) * RASTER_PX;
  if (any(greaterThanEqual(pixel, frame.size_px))) return;  // a helper thread
  const LightProxy proxy = proxies[in_light];
  const bool everywhere = reaches_everywhere();
  const vec2 depths = everywhere ? vec2(proxy.z_near, proxy.z_far) : clamp(face, proxy.z_near, proxy.z_far);
  uvec2 slices = slices_of(depths.x, depths.y);
  const uvec2 tile = pixel / TILE_PX;
  const uint bit = 1u << (in_light % 32u);
  if (MODE == CLUSTERS_WALK) slices.y = farthest_mark(tile, bit, slices.x, slices_of(proxy.z_far, proxy.z_far).y);
  if (MODE == CLUSTERS_FROM_EYE) slices.x = 0u;
  for (uint slice = slices.x; slice <= slices.y; ++slice) set_bit(cluster_word(tile, slice), bit);
}
