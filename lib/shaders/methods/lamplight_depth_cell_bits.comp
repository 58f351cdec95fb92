// Depths of tiles and cells, for lights that leave a bit in each cell that they find.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "common/depth_image.glsl"
#define CELL_BITS
#include "methods/lamplight_depth_main.glsl"
