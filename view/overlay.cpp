// One function for each overlay.
// Based on: Nuñez, Anderton, Renslow, Optimizing colormaps with consideration for color vision deficiency (cividis),
// PLOS ONE 13 (2018), for blue-yellow: five of its colours, which differ for all kinds of colour vision.
// SPDX-License-Identifier: Apache-2.0
#include "view/overlay.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <unordered_map>

#include "render/heatmap_legend.h"
#include "render/shaders/sky_cell.h"
#include "scene/procedural_random.h"
#include "view/overlay_colors.h"

namespace lamp::app {
namespace {

using gpu::SKY_CELL;

constexpr std::array<glm::u8vec3, 5> CIVIDIS{
    {{0, 34, 78}, {65, 77, 107}, {124, 123, 120}, {188, 175, 111}, {254, 232, 56}}};

glm::u8vec3 between(std::span<const glm::u8vec3> ramp, double position) {
  const double place = std::clamp(position, 0.0, 1.0) * static_cast<double>(ramp.size() - 1);
  const std::size_t left = std::min(static_cast<std::size_t>(place), ramp.size() - 2);
  const auto weight = static_cast<float>(place - static_cast<double>(left));
  return glm::u8vec3(glm::mix(glm::vec3(ramp[left]), glm::vec3(ramp[left + 1]), weight) + 0.5F);
}

std::uint64_t cells_seen(const Walked& walked) {
  std::vector<std::uint32_t> cells;
  for (const Visit& visit : walked.visits)
    if (visit.cell != SKY_CELL && (cells.empty() || cells.back() != visit.cell)) cells.push_back(visit.cell);
  std::ranges::sort(cells);
  return static_cast<std::uint64_t>(std::ranges::distance(cells.begin(), std::ranges::unique(cells).begin()));
}

/// Calls `color` for every pixel that has a cell.
template <class Color>
std::vector<std::uint32_t> for_pixels(const Walked& walked, const Color& color) {
  std::vector<std::uint32_t> pixels(walked.visits.size(), sky_dimmed());
  for (std::size_t i = 0; i < pixels.size(); ++i)
    if (walked.visits[i].cell != SKY_CELL) pixels[i] = color(i);
  return pixels;
}

Overlaid heat(Palette palette, const Walked& walked) {
  std::vector<std::uint32_t> counts;
  counts.reserve(walked.visits.size());
  for (const Visit& visit : walked.visits) counts.push_back(visit.cell == SKY_CELL ? SKY_CELL : visit.visited);
  Overlaid made = heat_over(palette, counts, walked.scale_least, [](std::uint32_t) { return std::nullopt; });
  made.legend.overlay = Overlay::heat;
  made.legend.cells = cells_seen(walked);
  return made;
}

Overlaid cells(const Walked& walked) {
  return {
      .pixels = for_pixels(walked, [&](std::size_t i) { return rgba(cell_color(walked.visits[i].cell), MAP_ALPHA); }),
      .legend = {.overlay = Overlay::cells, .cells = cells_seen(walked)}};
}

struct Range {
  double near_m = 1e30;
  double far_m = 0.0;
};

Overlaid depth_range(Palette palette, const Walked& walked) {
  std::unordered_map<std::uint32_t, Range> ranges;
  for (std::size_t i = 0; i < walked.visits.size(); ++i) {
    if (walked.visits[i].cell == SKY_CELL) continue;
    Range& range = ranges[walked.visits[i].cell];
    const double z = walked.view.z_view(walked.depth[i]);
    range = {std::min(range.near_m, z), std::max(range.far_m, z)};
  }
  Legend legend{.overlay = Overlay::depth_range, .cells = ranges.size()};
  for (const auto& [cell, range] : ranges) {
    legend.max = std::max(legend.max, range.far_m - range.near_m);
    legend.mean += (range.far_m - range.near_m) / static_cast<double>(ranges.size());
  }
  legend.high = std::max({walked.scale_least, legend.max, 1e-3});
  return {.pixels = for_pixels(walked,
                               [&](std::size_t i) {
                                 const Range& range = ranges[walked.visits[i].cell];
                                 const double share = (range.far_m - range.near_m) / legend.high;
                                 return rgba(palette_color(palette, share), MAP_ALPHA);
                               }),
          .legend = legend};
}

Overlaid overflow(const Walked& walked) {
  Legend legend{.overlay = Overlay::overflow};
  const auto walks_all = [&](const Visit& visit) {
    return walked.overflowed && visit.cell != SKY_CELL && visit.visited >= walked.lights;
  };
  for (const Visit& visit : walked.visits) legend.cells += walks_all(visit) ? 1 : 0;
  return {
      .pixels = for_pixels(
          walked, [&](std::size_t i) { return walks_all(walked.visits[i]) ? rgba(SIGNAL, SIGNAL_ALPHA) : dimmed(); }),
      .legend = legend};
}

Overlaid missed(const Walked& walked) {
  Legend legend{.overlay = Overlay::missed};
  for (const Visit& visit : walked.visits) {
    legend.cells += visit.missed != 0 ? 1 : 0;
    legend.max += visit.missed;
  }
  return {
      .pixels = for_pixels(
          walked, [&](std::size_t i) { return walked.visits[i].missed != 0 ? rgba(SIGNAL, SIGNAL_ALPHA) : dimmed(); }),
      .legend = legend};
}

Overlaid difference(const Walked& walked) {
  Legend legend{.overlay = Overlay::difference};
  const auto more = [&](std::size_t i) {
    return static_cast<std::int64_t>(walked.visits[i].visited) - static_cast<std::int64_t>(walked.other[i].visited);
  };
  std::uint64_t seen = 0;
  for (std::size_t i = 0; i < walked.visits.size(); ++i) {
    if (walked.visits[i].cell == SKY_CELL) continue;
    ++seen;
    legend.cells += more(i) != 0 ? 1 : 0;
    legend.mean += static_cast<double>(more(i));
    legend.max = std::max(legend.max, std::abs(static_cast<double>(more(i))));
  }
  if (seen != 0) legend.mean /= static_cast<double>(seen);
  legend.high = std::max(legend.max, 1.0);
  return {.pixels = for_pixels(walked,
                               [&](std::size_t i) {
                                 const glm::vec3 color(more(i) > 0 ? FIRST_WALKS_MORE : SECOND_WALKS_MORE);
                                 // By the root, so that single lights show beside hundreds.
                                 const double share = std::sqrt(std::abs(static_cast<double>(more(i))) / legend.high);
                                 return rgba(glm::u8vec3(color * static_cast<float>(share) + 0.5F), MAP_ALPHA);
                               }),
          .legend = legend};
}

}  // namespace

glm::u8vec3 cell_color(std::uint32_t cell) {
  constexpr std::array<double, 4> LIGHTNESS{0.45, 0.65, 0.85, 1.0};
  const double hue = 6.0 * procedural::hash_unit(cell, 0, 0);
  const double lightness = LIGHTNESS[static_cast<std::size_t>(4.0F * procedural::hash_unit(cell, 0, 1))];
  const auto channel = [&](double shift) {
    const double k = std::fmod(hue + shift, 6.0);
    return 255.0 * lightness * (1.0 - 0.75 * std::clamp(std::min(k, 4.0 - k), 0.0, 1.0));
  };
  return {channel(5.0), channel(3.0), channel(1.0)};
}

Overlaid refused_overlay(Overlay overlay, std::size_t pixels, std::string why) {
  return {.pixels = std::vector<std::uint32_t>(pixels), .legend = {.overlay = overlay, .refused = std::move(why)}};
}

std::vector<ListLengths> list_lengths(std::span<const Visit> visits) {
  std::unordered_map<std::uint32_t, std::uint32_t> lengths;
  for (const Visit& visit : visits) {
    if (visit.cell == SKY_CELL) continue;
    std::uint32_t& length = lengths[visit.cell];
    length = std::max(length, visit.visited);
  }
  std::vector<ListLengths> bins;
  for (const auto& [cell, length] : lengths) {
    const auto place = static_cast<std::size_t>(length == 0 ? 0 : 1 + std::bit_width(length - 1));
    while (bins.size() <= place) {
      const std::uint64_t high = bins.empty() ? 0 : std::uint64_t{1} << (bins.size() - 1);
      bins.push_back({.low = bins.empty() ? 0 : bins.back().high + 1,
                      .high = static_cast<std::uint32_t>(std::min<std::uint64_t>(high, ~0U))});
    }
    ++bins[place].cells;
  }
  return bins;
}

glm::u8vec3 palette_color(Palette palette, double position) {
  constexpr std::array<glm::u8vec3, 2> GREY{{{20, 20, 20}, {255, 255, 255}}};
  switch (palette) {
    case Palette::rainbow:
      return heat_ramp(position);
    case Palette::blue_yellow:
      return between(CIVIDIS, position);
    case Palette::grey:
      break;
  }
  return between(GREY, position);
}

Overlaid heat_over(Palette palette, std::span<const std::uint32_t> counts, double scale_least,
                   const std::function<std::optional<glm::u8vec3>(std::uint32_t)>& special) {
  Legend legend{.low = 1.0};
  std::vector<std::uint32_t> pixels(counts.size(), sky_dimmed());
  std::uint64_t seen = 0;
  std::uint32_t most = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] == SKY_CELL) continue;
    if (const auto color = special(counts[i])) {
      pixels[i] = rgba(*color, SIGNAL_ALPHA);
      ++legend.cells;
      continue;
    }
    legend.mean += counts[i];
    ++seen;
    most = std::max(most, counts[i]);
  }
  if (seen != 0) legend.mean /= static_cast<double>(seen);
  const std::uint32_t own = most > 1U << 31 ? most : std::bit_ceil(std::max(most, 2U));  // as `lamp render --heatmap`
  const std::uint32_t top = std::max(own, static_cast<std::uint32_t>(scale_least));
  legend.high = top;
  legend.max = most;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] == SKY_CELL || special(counts[i])) continue;
    const glm::u8vec3 color = counts[i] == 0 ? glm::u8vec3(0) : palette_color(palette, heat_position(counts[i], top));
    pixels[i] = rgba(color, MAP_ALPHA);
  }
  return {.pixels = std::move(pixels), .legend = legend};
}

Overlaid make_slice(Palette palette, const Walked& walked, double slice_m) {
  constexpr std::uint32_t HIDDEN_SHARE = 3;  // of the alpha that points before all surfaces have
  Overlaid made = heat(palette, walked);
  made.legend.overlay = Overlay::slice;
  for (std::size_t i = 0; i < made.pixels.size(); ++i) {
    if (walked.depth[i] == walked.view.sky_depth() || walked.view.z_view(walked.depth[i]) >= slice_m) continue;
    const std::uint32_t alpha = (made.pixels[i] >> 24U) / HIDDEN_SHARE;
    made.pixels[i] = (made.pixels[i] & 0xFFFFFFU) | alpha << 24U;
  }
  return made;
}

Overlaid make_overlay(Overlay overlay, Palette palette, const Walked& walked) {
  switch (overlay) {
    case Overlay::heat:
      return heat(palette, walked);
    case Overlay::cells:
      return cells(walked);
    case Overlay::depth_range:
      return depth_range(palette, walked);
    case Overlay::overflow:
      return app::overflow(walked);
    case Overlay::missed:
      return app::missed(walked);
    case Overlay::difference:
      return difference(walked);
    case Overlay::shadow_atlas:  // of no walk: make_shadow_overlay, make_shadow_heat, make_shadow_leaks
    case Overlay::shadow_age:
    case Overlay::shadow_size:
    case Overlay::shadow_leaks:
    case Overlay::slice:        // of another walk: make_slice
    case Overlay::light_cells:  // make_light_cells
    case Overlay::mask:         // make_mask_overlay
    case Overlay::none:
      break;
  }
  return {};
}

}  // namespace lamp::app
