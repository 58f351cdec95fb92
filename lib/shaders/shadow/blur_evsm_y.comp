// The blur of evsm in two passes, the second: along y.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "shadow/parts/blur_of_evsm.glsl"
#include "shadow/parts/blur_along_y.glsl"
