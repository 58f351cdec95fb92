// Look-up: one flat bit array a tile and depth range; bit N is light N.
// Based on: Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017).
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/shared/frame.h"

layout(constant_id = 100) const uint LOOKUP_TILE_PX = 16;
layout(constant_id = 101) const uint LOOKUP_WORDS = 1;
layout(constant_id = 102) const uint LOOKUP_RANGES = 1;
layout(set = 0, binding = 16, scalar) readonly buffer LookupFrame { Frame lookup_frame; };
layout(set = 0, binding = 17, scalar) readonly buffer LookupBits { uint lookup_bits[]; };
layout(set = 0, binding = 18, scalar) readonly buffer LookupSplits { float lookup_splits[]; };

#include "lookup/parts/tile_cell.glsl"

struct Walk {
  uint base;
  uint word;  // the next word to read
  uint words;
  uint bits;  // of word - 1, not yet walked
};

void lookup_prepare() {}

Walk walk_begin(uvec2 pixel, float z_view) {
  return Walk(lookup_cell(pixel, z_view) * LOOKUP_WORDS, 0u, (lookup_frame.light_count + 31u) / 32u, 0u);
}

bool walk_next(inout Walk walk, out uint light) {
  while (walk.bits == 0u) {
    if (walk.word >= walk.words) return false;
    walk.bits = lookup_bits[walk.base + walk.word++];
  }
  light = (walk.word - 1u) * 32u + uint(findLSB(walk.bits));
  walk.bits &= walk.bits - 1u;
  return true;
}
