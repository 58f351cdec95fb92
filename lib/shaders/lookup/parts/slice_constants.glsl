// How a look-up's depth is sliced: its constants from LOOKUP_SLICE_CONSTANT on, and the slice of a depth. Their names have
// a prefix, because look-ups are included by shaders that they know nothing of.
// Needs: LOOKUP_SLICE_CONSTANT.
// SPDX-License-Identifier: Apache-2.0
LOOKUP_CONSTANT(LOOKUP_SLICE_CONSTANT, uint, LOOKUP_SLICES, 1);
LOOKUP_CONSTANT(LOOKUP_SLICE_CONSTANT + 1, uint, LOOKUP_SLICE_SCALE, 0);
LOOKUP_CONSTANT(LOOKUP_SLICE_CONSTANT + 2, uint, LOOKUP_NEAR_MM, 500);
LOOKUP_CONSTANT(LOOKUP_SLICE_CONSTANT + 3, uint, LOOKUP_FAR_M, 500);

#define SLICES LOOKUP_SLICES
#define SLICE_SCALE LOOKUP_SLICE_SCALE
#define NEAR_MM LOOKUP_NEAR_MM
#define FAR_M LOOKUP_FAR_M
#include "common/slice_of.glsl"
#undef SLICES
#undef SLICE_SCALE
#undef NEAR_MM
#undef FAR_M
