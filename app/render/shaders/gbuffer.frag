// Writes the G-buffer.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common/write_gbuffer.glsl"

void main() { write_gbuffer(); }
