// What both pixel shaders of the boxes have in common: the surface and the lights.
// SPDX-License-Identifier: Apache-2.0
#include "lighting.glsl"

layout(set = 0, binding = 1, scalar) readonly buffer LightBuffer { HostLight lights[]; };
layout(location = 0) in vec3 position;
layout(location = 1) flat in vec3 normal;
layout(location = 2) flat in uint material;
layout(location = 0) out vec4 target;  // w: lights that were walked
