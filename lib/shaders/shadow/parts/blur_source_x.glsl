// What the first pass of the blur reads: depths.
// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/moments.glsl"

vec4 blur_source(ShadowDepths depths, ivec2 texel) {
  return shadow_moments_of_depth(shadow_unit_depth_of_stored(depths, SHADOW_TEXEL(shadow_atlas, texel).x));
}
