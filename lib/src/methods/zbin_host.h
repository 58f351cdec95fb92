// Z-binning on the CPU: the sort and the bins of drobot-zbin, as its source has them.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "lamplight/plan.h"

namespace lamp {

/// Which depths a light reaches, metres ahead. far < near: none.
struct DepthSpan {
  float middle = 0.0F;
  float near = 0.0F;
  float far = 0.0F;
};

/// Of the light's bounding sphere, never too short.
[[nodiscard]] DepthSpan depth_span(const shared::Frame& frame, const shared::Light& light);

/// Indices ascending by `middle`, equal ones in their order; those that reach nothing come last.
[[nodiscard]] std::vector<std::uint32_t> depth_order(std::span<const DepthSpan> spans);

/// Where depth is cut, as common/slices.glsl does it.
struct BinScale {
  std::uint32_t bins = 1;
  std::uint32_t scale = 0;  ///< shared::SLICES_LOG or SLICES_LINEAR
  std::uint32_t near_mm = 500;
  std::uint32_t far_m = 500;
};
[[nodiscard]] std::uint32_t bin_of(const BinScale& scale, double z_view);

/// Least and greatest rank in `order` of the lights that reach into a bin; least > greatest: none.
struct BinRanks {
  std::uint32_t least = ~0U;
  std::uint32_t greatest = 0;
};
[[nodiscard]] std::vector<BinRanks> bin_ranks(const BinScale& scale, std::span<const DepthSpan> spans,
                                              std::span<const std::uint32_t> order);

/// The host pass. Constants: bins, scale, near_mm, far_m, wide. Buffers: order, bins.
void sort_into_bins(const HostContext& context);

}  // namespace lamp
