// Tiled culling: a list a tile, depth bounds by subgroup operations.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "common/depth_image.glsl"
#include "common/reduce_subgroup.glsl"
#include "methods/tile_lists_main.glsl"
