// What all passes that blur moments have in common: the separable Gaussian of nine taps, three texels apart, over the
// squares that were drawn, each by itself.
// Promise: no texel of another square is read: taps end at the edge of a square, or fold across that of an octahedron.
// Needs: BLUR_FORMAT, BLUR_VECTOR (vec2 or vec4, moments of a texel).
// SPDX-License-Identifier: Apache-2.0
#ifndef SHADOW_BLUR_BLOCK
#define SHADOW_BLUR_BLOCK
#extension GL_EXT_control_flow_attributes : require
#include "shadow/parts/blur_step.glsl"
#include "shadow/parts/moments.glsl"
#include "shadow/parts/offset.glsl"

const int THREADS = 256;
layout(local_size_x = THREADS) in;

// A part of a square, for a work group: those of a square are counted line by line (app/render/shadow_moments.cpp).
struct BlurBlock {
  uint light;
  uint square;
  uint block;
};
layout(set = 0, binding = 3, scalar) readonly buffer BlockBuffer { BlurBlock blocks[]; };
layout(set = 0, binding = 4, BLUR_FORMAT) uniform writeonly image2D blurred;
layout(push_constant) uniform Push { uint block_count; };

const int TAPS = 9;
const int MOST_REACH = 12;  // texels, to the farthest tap

uint group_number() { return gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x; }

// What a block's threads would otherwise look up for each texel.
struct BlurSquare {
  uint light;
  uint square;
  int side;
  ivec2 corner;    // in the atlas
  bool folds;      // taps go on across an octahedron's edges
  float depth_of;  // over what is stored: depth 0 .. 1; 0: of a light that reaches everything
};

BlurSquare blur_square(BlurBlock block) {
  BlurSquare s;
  s.light = block.light;
  s.square = block.square;
  s.side = int(shadow_maps[block.light].side);
  const uint corner = shadow_maps[block.light].squares[block.square];
  s.corner = ivec2(int(corner & 0xffffu), int(corner >> 16u)) * int(LEAST_SQUARE);
  s.folds = shadow_maps[block.light].kind == SHADOW_OCTAHEDRON;
  const float longest = shadow_maps[block.light].range_m * (s.folds ? SHADOW_FOLDED_STEP : 1.0);
  s.depth_of = longest < 1e18 ? shadow_maps[block.light].near_m / longest : 0.0;
  return s;
}

// A texel of the square or beside it, in the atlas.
ivec2 blur_texel(BlurSquare s, ivec2 texel) {
  return s.folds ? shadow_texel(s.light, s.square, texel) : s.corner + clamp(texel, ivec2(0), ivec2(s.side - 1));
}

float blur_unit_depth(BlurSquare s, ivec2 at) {
  const float stored = SHADOW_TEXEL(shadow_atlas, at).x;
  if (s.depth_of == 0.0) return shadow_unit_depth_of_stored(s.light, stored);
  return stored > 0.0 ? min(s.depth_of / stored, 1.0) : 1.0;
}

// Of the square's own texels.
void blur_store(BlurSquare s, ivec2 texel, BLUR_VECTOR moments) {
  vec4 stored = vec4(0.0);
  [[unroll]] for (int i = 0; i < moments.length(); ++i) stored[i] = moments[i];
  imageStore(blurred, s.corner + texel, stored);
}

#endif
