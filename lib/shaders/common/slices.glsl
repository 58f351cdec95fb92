// Where depth slices of clusters and bins of lights (slice_of.glsl) begin and end.
// Needs: SLICES, SLICE_SCALE, NEAR_MM, FAR_M.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_SLICES
#define LAMP_COMMON_SLICES
#include "common/slice_of.glsl"

const float BEYOND_ALL_M = 1e18;

// Metres ahead where the i-th slice after the first begins.
float inner_edge(uint i) {
  const float share = float(i) / inner_slices();
  if (SLICE_SCALE == SLICES_LINEAR) return mix(slice_near_m(), float(FAR_M), share);
  return slice_near_m() * exp2(share * octaves());
}

// Where a slice begins, a little sooner than slice_of says.
float slice_begin(uint slice) {
  return slice == 0u ? -BEYOND_ALL_M : inner_edge(slice - 1u) * (1.0 - SLICE_ROUNDING);
}

// Where it ends, a little later.
float slice_end(uint slice) {
  return slice + 1u >= SLICES ? BEYOND_ALL_M : inner_edge(slice) * (1.0 + SLICE_ROUNDING);
}

// First and last slice of a range of depths, a little wider than it is.
uvec2 slices_of(float z_near, float z_far) {
  return uvec2(slice_of(z_near - SLICE_ROUNDING * abs(z_near)), slice_of(z_far + SLICE_ROUNDING * abs(z_far)));
}

#endif
