// The blur of evsm by the indices of the article's listing, the second pass: along y.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#define BLUR_ALONG_X 0
#include "shadow/parts/blur_of_evsm.glsl"
#include "shadow/parts/blur_listing.glsl"
