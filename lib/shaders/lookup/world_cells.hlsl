// world_cells.glsl for HLSL.
// SPDX-License-Identifier: Apache-2.0
#define LAMP_HLSL
#include "lookup/world_cells.glsl"
