// The blur of evsm in one pass: moments of depths, blurred along x and along y.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#define SHADOW_FIRST_BINDING 0
#define SHADOW_FIRST_CONSTANT 0
#define BLUR_FORMAT rgba32f
#define BLUR_VECTOR vec4
#define BLUR_SOURCE vec2
#include "shadow/parts/moments.glsl"

vec2 blur_source(float unit_depth) { return shadow_warped(unit_depth); }
vec4 blur_moments(vec2 warped) { return shadow_moments_of_warped(warped); }

#include "shadow/parts/blur_fused.glsl"
