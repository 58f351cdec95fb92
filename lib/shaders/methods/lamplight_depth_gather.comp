// Depths of tiles and cells, and the lights of cells, of which there are few. SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#define CELL_BITS
#define GATHERS
#include "methods/lamplight_depth_main.glsl"
