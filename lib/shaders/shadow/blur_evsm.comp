// The blur of evsm in one pass: moments of depths, blurred along x and along y.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shadow/parts/blur_of_evsm.glsl"
const int TURN_ROWS = 2;
#include "shadow/parts/blur_fused.glsl"
