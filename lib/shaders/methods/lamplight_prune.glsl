// Pruning by pixel: pairs of light and tile that no pixel of the tile confirms are dropped.
// Based on: Primal engine, Light Culling with Approximate Sphere-Cone Intersection, listing 9.
// Needs: TILE_PX; `frame`, `lights`, `depth_image`; Pair, s_lights.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_METHODS_LAMPLIGHT_PRUNE
#define LAMP_METHODS_LAMPLIGHT_PRUNE
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_shuffle : require
#extension GL_KHR_shader_subgroup_vote : require
#include "common/pixel_tests.glsl"

// For a subgroup together, each thread with a pair: whether any pixel of its tile is reached. Pairs one after the other,
// each by all threads.
bool keeps_pair(Cell cell, Pair own, bool reached) {
  bool keeps = false;
  for (uvec4 open = subgroupBallot(reached); open != uvec4(0u);) {
    const uint owner = subgroupBallotFindLSB(open);
    const uint id = s_lights[subgroupShuffle(own.entry, owner)];
    const Light light = lights[id];
    const uvec2 tile = tile_of_row(cell, subgroupShuffle(own.row, owner));
    bool any_pixel = false;
    for (uint first = 0u; first < tile_samples(depth_image) && !any_pixel; first += gl_SubgroupSize) {
      const PrunePixel pixel = prune_pixel(frame, depth_image, tile, first + gl_SubgroupInvocationID);
      any_pixel = subgroupAny(pixel.covered && reaches_pixel(frame, id, light, pixel));
    }
    if (owner == gl_SubgroupInvocationID) keeps = any_pixel;
    open[owner / 32u] &= ~(1u << (owner % 32u));
  }
  return keeps;
}

#endif
