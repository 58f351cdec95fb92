// Mirrored light, from the lights of the grid's cells.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lamplight/shared/frame.h"
#include "lookup/implicit_grid.glsl"
Walk mirror_walk_begin(vec3 position) { return world_walk_begin(position); }
#include "common/mirror_shade.glsl"
