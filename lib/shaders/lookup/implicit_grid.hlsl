// implicit_grid.glsl for HLSL.
// SPDX-License-Identifier: Apache-2.0
#define LAMP_HLSL
#include "lookup/implicit_grid.glsl"
