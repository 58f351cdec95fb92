// triangle_lists.glsl for HLSL.
// SPDX-License-Identifier: Apache-2.0
#define LAMP_HLSL
#include "world/triangle_lists.glsl"
