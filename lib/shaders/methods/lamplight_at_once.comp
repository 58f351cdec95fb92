// Lists of tiles in one pass, of few lights.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "common/depth_image.glsl"
#include "methods/lamplight_at_once_main.glsl"
