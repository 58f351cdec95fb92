// The last pass of `lamplight`: tiles, pruned by pixel, of cells with a bit for each light.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "common/depth_image.glsl"
#define PRUNED
#define CELL_BITS
#include "methods/lamplight_lists_main.glsl"
