// Look-up: one flat bit array a tile, cut by the bin of the pixel's depth; the subgroup walks one light at a time.
// SPDX-License-Identifier: Apache-2.0
#include "lookup/parts/tile_zbins.glsl"
#include "lookup/parts/scalar_bits.glsl"
