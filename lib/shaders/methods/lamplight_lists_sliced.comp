// The last pass of `lamplight` without a depth buffer: tiles cut into slices of depth.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#define SLICED
#include "methods/lamplight_lists_main.glsl"
