// Normal and material, for deferred shading.
// SPDX-License-Identifier: Apache-2.0
#version 460
layout(location = 0) flat in vec4 surface;
layout(location = 0) out vec4 target;

void main() { target = surface; }
