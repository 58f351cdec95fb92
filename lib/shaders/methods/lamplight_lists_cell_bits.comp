// The last pass of `lamplight`: tiles with the depths that they hold, of cells with a bit for each light.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#define CELL_BITS
#include "methods/lamplight_lists_main.glsl"
