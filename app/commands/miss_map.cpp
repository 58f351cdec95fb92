// Heat maps of misses, about as many side by side as below each other.
// SPDX-License-Identifier: Apache-2.0
#include "commands/miss_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "render/heatmap.h"

namespace lamp::app {
namespace {

std::vector<std::uint32_t> counts_of(const MethodMisses& method, const LdrImage& picture) {
  std::vector<std::uint32_t> counts(picture.pixels.size(), 0);
  for (const PixelMisses& misses : method.pixels) counts[misses.pixel] = std::max(counts[misses.pixel], misses.missed);
  return counts;
}

LdrImage draw(const LdrImage& picture, std::span<const std::uint32_t> counts, std::uint32_t scale,
              const std::string& title) {
  return draw_heatmap({.width = picture.width,
                       .height = picture.height,
                       .counts = counts,
                       .scale_max = scale,
                       .title = title,
                       .overlay = &picture});
}

}  // namespace

LdrImage draw_misses(std::span<const MethodMisses> methods, const LdrImage& picture) {
  std::vector<std::vector<std::uint32_t>> counts;
  std::vector<std::string> titles;
  std::uint32_t most = 1;
  for (const MethodMisses& method : methods) {
    if (method.pixels.empty()) continue;
    counts.push_back(counts_of(method, picture));
    titles.push_back(fmt::format("{}: {} missed", method.method, method.missed));
    most = std::max(most, std::ranges::max(counts.back()));
  }
  if (counts.empty()) {
    counts.emplace_back(picture.pixels.size(), 0);
    titles.push_back(methods.size() == 1 ? methods.front().method + ": 0 missed" : "no method misses a light");
  }
  const auto columns = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(counts.size()))));
  std::vector<LdrImage> rows;
  std::vector<LdrImage> row;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    row.push_back(draw(picture, counts[i], std::bit_ceil(most), titles[i]));
    if (row.size() != columns && i + 1 != counts.size()) continue;
    rows.push_back(side_by_side(row));
    row.clear();
  }
  return stacked(rows);
}

}  // namespace lamp::app
