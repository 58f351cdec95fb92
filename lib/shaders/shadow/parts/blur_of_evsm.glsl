// What the blur of evsm reads and writes: BLUR_SOURCE is what a group shares of a texel, BLUR_VECTOR its moments.
// SPDX-License-Identifier: Apache-2.0
#define SHADOW_FIRST_BINDING 0
#define SHADOW_FIRST_CONSTANT 0
#define BLUR_FORMAT rgba32f
#define BLUR_VECTOR vec4
#define BLUR_SOURCE vec2
#include "shadow/parts/moments.glsl"

vec2 blur_source(float unit_depth) { return shadow_warped(unit_depth); }
vec4 blur_moments(vec2 warped) { return shadow_moments_of_warped(warped); }
