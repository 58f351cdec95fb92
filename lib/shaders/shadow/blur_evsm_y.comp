// The second pass of the blur of evsm: along y.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#define SHADOW_FIRST_BINDING 0
#define SHADOW_FIRST_CONSTANT 0
#define BLUR_FORMAT rgba32f
#define BLUR_VECTOR vec4
const bool BLUR_ALONG_X = false;
#include "shadow/parts/blur_source_y.glsl"
#include "shadow/parts/blur_lines.glsl"
