// Clusters, each one flat bit array; bit N is light N.
// Based on: Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017).
// SPDX-License-Identifier: Apache-2.0
#include "lookup/parts/cluster_cell.glsl"

LOOKUP_CONSTANT(5, uint, LOOKUP_WORDS, 1);
LOOKUP_BUFFER(1, LookupBits, uint, lookup_bits);
LOOKUP_VIEW_WORDS(1, LOOKUP_BITS_VIEW);

#include "lookup/parts/cell_bit_array.glsl"
