// Look-up: one flat bit array a cluster; the subgroup walks one light at a time.
// SPDX-License-Identifier: Apache-2.0
#include "lookup/parts/cluster_bits.glsl"
#include "lookup/parts/scalar_bits.glsl"
