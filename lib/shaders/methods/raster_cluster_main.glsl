// A fragment of a light's proxy: sets the light's bit in clusters of its tile.
// Based on: Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017), "Cluster Rasterizer".
// Promise: the bits of a tile reach from the nearest front to the farthest back without a gap, as far as there are surfaces
// where the depth pre-pass ends them early. A walk looks for the farthest mark of its tile first, because marks may have
// gaps where a sliver of the back lies between two pixels. TO_FIRST_MARK is the source's walk, which may miss what lies
// behind a gap.
// Needs: set_bit(word, bit).
// SPDX-License-Identifier: Apache-2.0
#include "common/atomic_load.glsl"
#include "methods/raster_face.glsl"

layout(constant_id = 7) const uint MODE = 0;
#define SLICE_CONSTANT 8
#include "common/slice_constants.glsl"
layout(constant_id = 12) const uint EARLY_PX = 0;  // side of the squares that `ranges` holds the surfaces' depths of; 0: none
layout(constant_id = 13) const uint FURTHER = 0;  // FURTHER_*
layout(constant_id = 14) const bool TO_FIRST_MARK = false;
#define RADIAL_BINDING 7
#include "methods/raster_further.glsl"
#include "common/tile_volume.glsl"
#include "lamplight/shared/tile.h"

layout(set = 0, binding = 6, scalar) readonly buffer RangeBuffer { TileRanges ranges[]; };

// Slices between the nearest and the farthest surface around a pixel; x > y: none. Without the depth pre-pass, all.
uvec2 surface_slices(uvec2 pixel) {
  if (EARLY_PX == 0u) return uvec2(0u, SLICES - 1u);
  const uint side = max(EARLY_PX, 1u);
  const uvec2 at = pixel / side;
  const TileRanges range = ranges[at.x + (frame.size_px.x + side - 1u) / side * at.y];
  return range.z_near[0] > range.z_far[0] ? uvec2(1u, 0u) : slices_of(range.z_near[0], range.z_far[0]);
}

uint cluster_word(uvec2 tile, uint slice) {
  const uvec2 tiles = squares_across(frame, TILE_PX);
  return (tile.x + tiles.x * (tile.y + tiles.y * slice)) * WORDS + in_light / 32u;
}

// The farthest slice of the tile, up to `last`, that holds the bit; `last` if none does: then the back was too thin for
// any pixel. Other walks set bits meanwhile, but none beyond the farthest mark.
uint farthest_mark(uvec2 tile, uint bit, uint first, uint last) {
  for (uint slice = last + 1u; slice > first; --slice)
    if ((LOAD_OF_DEVICE(bits[cluster_word(tile, slice - 1u)]) & bit) != 0u) return slice - 1u;
  return last;
}

// The first slice of the tile, from `first` to `last`, that holds the bit; `last` if none does. Walks that begin farther
// back set bits meanwhile: who ends at those goes on where they went.
uint first_mark(uvec2 tile, uint bit, uint first, uint last) {
  for (uint slice = first; slice < last; ++slice)
    if ((LOAD_OF_DEVICE(bits[cluster_word(tile, slice)]) & bit) != 0u) return slice;
  return last;
}

// The further tests of a cluster.
bool passes_in_cluster(uvec2 tile, uint slice, LightProxy proxy) {
  if (FURTHER == 0u) return true;
  vec4 x_edges;
  vec4 y_edges;
  tile_edges(frame, vec2(tile * TILE_PX), vec2((tile + 1u) * TILE_PX), x_edges, y_edges);
  const float eye = from_eye(frame, -BEYOND_ALL_M);
  return passes_in_proxy(x_edges, y_edges,
                         vec2(max(max(slice_begin(slice), proxy.z_near), eye), min(slice_end(slice), proxy.z_far)));
}

void main() {
  const vec2 face = face_depths(1.0);
  const uvec2 pixel = uvec2(gl_FragCoord.xy) * RASTER_PX;
  if (any(greaterThanEqual(pixel, frame.size_px))) return;  // a helper thread
  const LightProxy proxy = proxies[in_light];
  const bool everywhere = reaches_everywhere();
  const vec2 depths = everywhere ? vec2(proxy.z_near, proxy.z_far) : clamp(face, proxy.z_near, proxy.z_far);
  const uvec2 surface = surface_slices(pixel);
  uvec2 slices = slices_of(depths.x, depths.y);
  const uvec2 tile = pixel / TILE_PX;
  const uint bit = 1u << (in_light % 32u);
  if (MODE == CLUSTERS_WALK && slices.x <= surface.y) {
    const uint last = slices_of(proxy.z_far, proxy.z_far).y;
    slices.y = TO_FIRST_MARK ? first_mark(tile, bit, slices.x, last) : farthest_mark(tile, bit, slices.x, last);
  }
  if (MODE == CLUSTERS_FROM_EYE) slices.x = 0u;
  // Marks stay where they are: a walk must not take one that is left out for a back too thin to see.
  if (MODE != CLUSTERS_MARK) slices = uvec2(max(slices.x, surface.x), min(slices.y, surface.y));
  for (uint slice = slices.x; slice <= slices.y; ++slice)
    if (MODE == CLUSTERS_MARK || passes_in_cluster(tile, slice, proxy)) set_bit(cluster_word(tile, slice), bit);
}
