// The last pass of `lamplight` without a depth buffer: tiles cut into slices of depth, of cells with a bit for each light.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#define SLICED
#define CELL_BITS
#include "methods/lamplight_lists_main.glsl"
