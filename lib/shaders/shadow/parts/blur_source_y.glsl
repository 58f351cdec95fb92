// What the second pass of the blur reads: what the first wrote.
// SPDX-License-Identifier: Apache-2.0
#include "shadow/parts/moments.glsl"

vec4 blur_source(ShadowDepths depths, ivec2 texel) { return SHADOW_TEXEL(shadow_moments, texel); }
