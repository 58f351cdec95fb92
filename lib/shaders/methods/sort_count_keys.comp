// sort_count_main.glsl, by keys.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#define SORT_BY uint
#include "methods/sort_count_main.glsl"
