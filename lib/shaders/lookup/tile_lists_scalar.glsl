// Look-up: one list a tile and depth range; the subgroup walks one cell at a time.
// SPDX-License-Identifier: Apache-2.0
#include "lookup/parts/tile_lists.glsl"
#include "lookup/parts/scalar_cells.glsl"
