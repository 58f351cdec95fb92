// The depth slice of a cluster, and the bin of lights, that a depth lies in: the first reaches from the eye to NEAR_MM, the
// last from FAR_M to infinity, the others grow by a constant factor in between, or have the same length.
// Based on: Olsson, Billeter, Assarsson, Clustered Deferred and Forward Shading, HPG (2012), section 3.2; same length:
// Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017), Z-binning.
// Needs: SLICES, SLICE_SCALE, NEAR_MM, FAR_M.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_SLICE_OF
#define LAMP_COMMON_SLICE_OF
#include "lamplight/shared/slices.h"

float slice_near_m() { return float(NEAR_MM) * 1e-3; }
float inner_slices() { return float(max(1u, SLICES - min(SLICES, 2u))); }
float octaves() { return log2(float(FAR_M) / slice_near_m()); }

uint slice_of(float z_view) {
  if (z_view < slice_near_m()) return 0u;
  const float share = SLICE_SCALE == SLICES_LINEAR ? (z_view - slice_near_m()) / (float(FAR_M) - slice_near_m())
                                                   : log2(z_view / slice_near_m()) / octaves();
  return min(SLICES - 1u, 1u + uint(clamp(share * inner_slices(), 0.0, MOST_SLICES)));
}

#endif
