// Lights look for cells in layers of depth, without a depth buffer, and leave a bit in each.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_KHR_shader_subgroup_ballot : require
#define SLICED
#define CELL_BITS
#include "methods/lamplight_find_main.glsl"
