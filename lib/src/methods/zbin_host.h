// Z-binning on the CPU: the sort and the bins of drobot-zbin, as its source has them.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "lamplight/plan.h"

namespace lamp {

/// The host pass. Constants: bins, scale, near_mm, far_m, wide. Buffers: order, bins.
void sort_into_bins(const HostContext& context);

}  // namespace lamp
