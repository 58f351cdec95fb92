// What the first pass of the blur reads: depths.
// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/blur_block.glsl"

vec4 blur_source(BlurSquare s, ivec2 texel) { return shadow_moments_of_depth(blur_unit_depth(s, texel)); }
