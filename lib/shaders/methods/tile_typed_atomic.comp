// Tiled culling: one shared list by type, depth bounds by atomics, or from their own pass.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "common/depth_image.glsl"
#include "common/reduce_atomic.glsl"
#include "methods/tile_typed_main.glsl"
