// The counting shader, for the method `clustered`.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lookup/cluster_lists.glsl"
#include "count.glsl"
