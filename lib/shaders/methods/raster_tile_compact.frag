// Rasterised culling of tiles, one atomic a word and subgroup.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "common/depth_image.glsl"
#include "methods/raster_inputs.glsl"

layout(set = 0, binding = 7, scalar) buffer BitBuffer { uint bits[]; };
#include "methods/raster_compact.glsl"
#include "methods/raster_tile_main.glsl"
