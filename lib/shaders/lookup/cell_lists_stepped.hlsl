// cell_lists_stepped.glsl for HLSL.
// SPDX-License-Identifier: Apache-2.0
#define LAMP_HLSL
#include "lookup/cell_lists_stepped.glsl"
