// Depth slices of clusters: the first reaches from the eye to SLICE_NEAR_M, the last from SLICE_FAR_M to infinity, the
// others grow by a constant factor in between.
// Based on: Olsson, Billeter, Assarsson, Clustered Deferred and Forward Shading, HPG (2012), section 3.2.
// Needs: SLICES, NEAR_MM, FAR_M.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_COMMON_SLICES
#define LAMP_COMMON_SLICES

// log2 and exp2 of different devices and places agree to far better than this share of a depth.
const float SLICE_ROUNDING = 1e-4;
const float BEYOND_ALL_M = 1e18;

float slice_near_m() { return float(NEAR_MM) * 1e-3; }
float log_slices() { return float(max(1u, SLICES - min(SLICES, 2u))); }
float octaves() { return log2(float(FAR_M) / slice_near_m()); }

uint slice_of(float z_view) {
  if (z_view < slice_near_m()) return 0u;
  const float s = log2(z_view / slice_near_m()) / octaves() * log_slices();
  return min(SLICES - 1u, 1u + uint(clamp(s, 0.0, 1024.0)));
}

// Where a slice begins, a little sooner than slice_of says.
float slice_begin(uint slice) {
  if (slice == 0u) return -BEYOND_ALL_M;
  return slice_near_m() * exp2(float(slice - 1u) / log_slices() * octaves()) * (1.0 - SLICE_ROUNDING);
}

// Where it ends, a little later.
float slice_end(uint slice) {
  if (slice + 1u >= SLICES) return BEYOND_ALL_M;
  return slice_near_m() * exp2(float(slice) / log_slices() * octaves()) * (1.0 + SLICE_ROUNDING);
}

#endif
