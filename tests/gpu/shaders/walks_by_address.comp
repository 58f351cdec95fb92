// walks.comp with the look-up's buffers by their addresses, of which it must write the same words.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_buffer_reference_uvec2 : require
#include "lamplight/shared/frame.h"

layout(local_size_x_id = 0, local_size_y_id = 1) in;
layout(constant_id = 2) const uint VIEW = 0;
#define LOOKUP_VIEW VIEW
layout(set = 0, binding = 0, scalar) readonly buffer FrameBuffer { Frame frame; };
layout(set = 0, binding = 1, scalar) writeonly buffer WordBuffer { uint words[]; };
layout(set = 0, binding = 2, scalar) readonly buffer AddressBuffer { uvec2 addresses[]; };
#define LOOKUP_ADDRESSES addresses
#include "lookup.glsl"
#include "lookup/parts/each.glsl"
#include "common/frame.glsl"
#include "walks_hash.glsl"
#include "walks_words.glsl"
