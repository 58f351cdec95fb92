// The blur of evsm, both directions in one pass.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#define SHADOW_FIRST_BINDING 0
#define SHADOW_FIRST_CONSTANT 0
#define BLUR_FORMAT rgba32f
#define BLUR_VECTOR vec4
#include "shadow/parts/blur_fused.glsl"
