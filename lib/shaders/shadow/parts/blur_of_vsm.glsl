// What the blur of vsm reads and writes: BLUR_SOURCE is what a group shares of a texel, BLUR_VECTOR its moments.
// SPDX-License-Identifier: Apache-2.0
#define SHADOW_FIRST_BINDING 0
#define SHADOW_FIRST_CONSTANT 0
#define BLUR_FORMAT rg32f
#define BLUR_VECTOR vec2
#define BLUR_SOURCE float
#include "shadow/parts/moments.glsl"

float blur_source(float unit_depth) { return unit_depth; }
vec2 blur_moments(float unit_depth) { return shadow_moments_of_depth(unit_depth).xy; }
