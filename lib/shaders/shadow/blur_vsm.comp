// The blur of vsm in one pass: moments of depths, blurred along x and along y.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#define SHADOW_FIRST_BINDING 0
#define SHADOW_FIRST_CONSTANT 0
#define BLUR_FORMAT rg32f
#define BLUR_VECTOR vec2
#define BLUR_SOURCE float
#include "shadow/parts/moments.glsl"

float blur_source(float unit_depth) { return unit_depth; }
vec2 blur_moments(float unit_depth) { return shadow_moments_of_depth(unit_depth).xy; }

#include "shadow/parts/blur_fused.glsl"
