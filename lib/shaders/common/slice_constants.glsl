// How depth is sliced: the constants of a pass from SLICE_CONSTANT on, and what follows from them.
// Needs: SLICE_CONSTANT.
// SPDX-License-Identifier: Apache-2.0
layout(constant_id = SLICE_CONSTANT) const uint SLICES = 24;
layout(constant_id = SLICE_CONSTANT + 1) const uint SLICE_SCALE = 0;
layout(constant_id = SLICE_CONSTANT + 2) const uint NEAR_MM = 500;
layout(constant_id = SLICE_CONSTANT + 3) const uint FAR_M = 500;
#include "common/slices.glsl"
