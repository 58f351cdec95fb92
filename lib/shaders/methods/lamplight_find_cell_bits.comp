// Lights look for the cells whose depths they meet, and leave a bit in each.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_KHR_shader_subgroup_ballot : require
#define CELL_BITS
#include "methods/lamplight_find_main.glsl"
