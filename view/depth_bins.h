// Bins of depth (z-bins) as a strip: which ranks of the lights, sorted by depth, each bin has a pixel walk. Pure but
// for the drawing.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "view/gui.h"
#include "view/shown.h"

namespace lamp::app {

/// As a plan's buffer has them: 16 + 16 bits, or two words where there are many lights.
[[nodiscard]] std::vector<BinRanks> decode_bins(std::span<const std::uint32_t> words, bool wide);

/// A column of the strip: all bins that lie in it, and the longest of them.
struct BinColumn {
  BinRanks all;
  std::uint32_t longest = 0;
};
/// So many columns of the first `bins`.
[[nodiscard]] std::vector<BinColumn> bin_columns(std::span<const BinRanks> bins, std::size_t columns);
/// How many of the first bins hold all lights, at least one.
[[nodiscard]] std::size_t used_bins(std::span<const BinRanks> bins);

/// Pixels of the screen, with a margin; 0: nothing is drawn.
[[nodiscard]] float depth_bins_height(const Shown& shown, float scale);
/// The strip at the bottom of the picture; the bins of the picked pixel and of the one under the mouse are marked.
void draw_depth_bins(const Shown& shown, const ScreenRect& picture, float scale);

}  // namespace lamp::app
