// Look-up: one flat bit array a tile, cut by the bin of the pixel's depth; each thread walks its own.
// SPDX-License-Identifier: Apache-2.0
#include "lookup/parts/tile_zbins.glsl"
