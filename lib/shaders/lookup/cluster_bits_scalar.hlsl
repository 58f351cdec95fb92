// cluster_bits_scalar.glsl for HLSL.
// SPDX-License-Identifier: Apache-2.0
#define LAMP_HLSL
#include "lookup/cluster_bits_scalar.glsl"
