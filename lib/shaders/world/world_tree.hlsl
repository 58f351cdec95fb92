// world_tree.glsl for HLSL.
// SPDX-License-Identifier: Apache-2.0
#define LAMP_HLSL
#include "world/world_tree.glsl"
