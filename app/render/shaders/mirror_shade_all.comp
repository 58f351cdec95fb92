// Mirrored light, from every light.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lamplight/shared/frame.h"
#include "lookup/all.glsl"
Walk mirror_walk_begin(vec3 position) { return walk_begin(uvec2(0u), 1.0); }
#include "common/mirror_shade.glsl"
