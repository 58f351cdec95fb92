// The counting shader, for the method `tiled-bits`; the look-up's bindings stand right behind its own.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#define LOOKUP_FIRST_BINDING 3
#define LOOKUP_FIRST_CONSTANT 0
#include "lookup/tile_bits.glsl"
#include "count.glsl"
