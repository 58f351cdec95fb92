// Look-up: one list of any length a cluster; each thread walks its own.
// SPDX-License-Identifier: Apache-2.0
#include "lookup/parts/cluster_lists.glsl"
