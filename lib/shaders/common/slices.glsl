// Depth slices of clusters, and bins of lights: the first reaches from the eye to SLICE_NEAR_M, the last from SLICE_FAR_M
// to infinity, the others grow by a constant factor in between, or have the same length.
// Based on: Olsson, Billeter, Assarsson, Clustered Deferred and Forward Shading, HPG (2012), section 3.2; same length:
// Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017), Z-binning.
// Needs: SLICES, SLICE_SCALE, NEAR_MM, FAR_M.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_SLICES
#define LAMP_COMMON_SLICES
#include "lamplight/shared/slices.h"

const float BEYOND_ALL_M = 1e18;

float slice_near_m() { return float(NEAR_MM) * 1e-3; }
float inner_slices() { return float(max(1u, SLICES - min(SLICES, 2u))); }
float octaves() { return log2(float(FAR_M) / slice_near_m()); }

uint slice_of(float z_view) {
  if (z_view < slice_near_m()) return 0u;
  const float share = SLICE_SCALE == SLICES_LINEAR ? (z_view - slice_near_m()) / (float(FAR_M) - slice_near_m())
                                                   : log2(z_view / slice_near_m()) / octaves();
  return min(SLICES - 1u, 1u + uint(clamp(share * inner_slices(), 0.0, MOST_SLICES)));
}

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
