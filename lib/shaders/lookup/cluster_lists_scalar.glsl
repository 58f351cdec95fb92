// Look-up: one list of any length a cluster; the subgroup walks one cell at a time.
// SPDX-License-Identifier: Apache-2.0
#include "lookup/parts/cluster_lists.glsl"
#include "lookup/parts/scalar_cells.glsl"
