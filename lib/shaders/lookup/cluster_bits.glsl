// Look-up: one flat bit array a cluster; each thread walks its own.
// SPDX-License-Identifier: Apache-2.0
#include "lookup/parts/cluster_bits.glsl"
