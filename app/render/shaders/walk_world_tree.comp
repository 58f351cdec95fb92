// Walks the look-up `world_tree` by position at many points.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lookup/world_tree.glsl"
#include "common/walk_points.glsl"
