// Walks the look-up `implicit_grid` by position at many points.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lookup/implicit_grid.glsl"
#include "common/walk_points.glsl"
