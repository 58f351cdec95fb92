// The heat map: a colour for each pixel's count, and below the picture the legend (heatmap_legend.cpp).
// Based on: Ottosson, A perceptual color space for image processing (Oklab), 2020, for the ramp's even steps.
// Promise: more lights are always a lighter colour, so that the map reads in print and for the colour-blind.
// SPDX-License-Identifier: Apache-2.0
#include "render/heatmap.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>

#include "render/heatmap_legend.h"

namespace lamp::app {
namespace {

constexpr glm::u8vec3 NO_LIGHT{0, 0, 0};
constexpr glm::u8vec3 SKY{28, 28, 32};

/// How much of the map an overlay lets through, and how much light it leaves to pixels without a cell.
constexpr float OVERLAY_ALPHA = 0.6F;
constexpr float OVERLAY_SKY = 0.3F;

/// sRGB at equal steps of the scale, from blue over green and yellow to white. Their Oklab lightness rises evenly from
/// 0.27 to 0.965 and their chroma is as large as sRGB has it there (at most 0.2).
constexpr std::array<glm::u8vec3, 13> RAMP{{{12, 4, 122},
                                            {5, 23, 153},
                                            {4, 67, 130},
                                            {7, 91, 127},
                                            {11, 113, 122},
                                            {15, 136, 106},
                                            {19, 160, 61},
                                            {108, 172, 19},
                                            {160, 182, 23},
                                            {204, 191, 26},
                                            {245, 201, 30},
                                            {254, 218, 166},
                                            {255, 240, 231}}};

/// The map's colour over a picture: the picture in grey shows what is where.
glm::u8vec4 lay_over(glm::u8vec3 heat, glm::u8vec4 below) {
  const float grey = luma(below);
  return {glm::u8vec3(glm::mix(glm::vec3(grey), glm::vec3(heat), OVERLAY_ALPHA) + 0.5F), 255};
}

const HeatSignal* signal_of(const Heatmap& map, std::uint32_t count) {
  const auto found = std::ranges::find(map.signals, count, &HeatSignal::count);
  return found == map.signals.end() ? nullptr : &*found;
}

glm::u8vec4 pixel_color(const Heatmap& map, std::size_t pixel, std::uint32_t top) {
  const std::uint32_t count = map.counts[pixel];
  if (const HeatSignal* signal = signal_of(map, count)) return {signal->color, 255};
  if (map.overlay == nullptr) return {count == SKY_CELL ? SKY : heat_color(count, top), 255};
  const glm::u8vec4 below = map.overlay->pixels[pixel];
  if (count == SKY_CELL) return {glm::u8vec3(OVERLAY_SKY * glm::vec3(below)), 255};
  return lay_over(heat_color(count, top), below);
}

/// The signals that pixels have, and how many.
void add_signals(const Heatmap& map, HeatSummary& summary) {
  for (const HeatSignal& signal : map.signals) {
    const auto pixels = std::ranges::count(map.counts, signal.count);
    if (pixels != 0) summary.signals.emplace_back(signal.color, fmt::format("{}: {} px", signal.meaning, pixels));
  }
}

/// Mean and maximum over the pixels that have a cell.
HeatSummary summarize(const Heatmap& map) {
  HeatSummary summary{.unit = map.unit};
  add_signals(map, summary);
  std::uint64_t sum = 0;
  std::uint64_t pixels = 0;
  for (const std::uint32_t count : map.counts) {
    if (count == SKY_CELL || signal_of(map, count) != nullptr) continue;
    sum += count;
    ++pixels;
    summary.max = std::max(summary.max, count);
  }
  if (pixels > 0) summary.mean = static_cast<double>(sum) / static_cast<double>(pixels);
  constexpr std::uint32_t LARGEST_POWER = 1U << 31;
  const std::uint32_t automatic = summary.max > LARGEST_POWER ? summary.max : std::bit_ceil(std::max(summary.max, 2U));
  summary.top = map.scale_max != 0 ? map.scale_max : automatic;
  return summary;
}

}  // namespace

double heat_position(double count, std::uint32_t scale_max) {
  if (scale_max <= 1) return 1.0;
  return std::clamp(std::log2(count) / std::log2(static_cast<double>(scale_max)), 0.0, 1.0);
}

glm::u8vec3 heat_ramp(double position) {
  const double place = position * static_cast<double>(RAMP.size() - 1);
  const std::size_t left = std::min(static_cast<std::size_t>(place), RAMP.size() - 2);
  const auto weight = static_cast<float>(place - static_cast<double>(left));
  return glm::u8vec3(glm::mix(glm::vec3(RAMP[left]), glm::vec3(RAMP[left + 1]), weight) + 0.5F);
}

glm::u8vec3 heat_color(std::uint32_t count, std::uint32_t scale_max) {
  return count == 0 ? NO_LIGHT : heat_ramp(heat_position(count, scale_max));
}

LdrImage draw_heatmap(const Heatmap& map) {
  const std::size_t pixels = static_cast<std::size_t>(map.width) * map.height;
  assert(map.counts.size() == pixels && "give a count for every pixel");
  assert((map.overlay == nullptr || map.overlay->pixels.size() == pixels) && "overlay a picture of the map's size");
  const HeatSummary summary = summarize(map);
  LdrImage image{map.width, map.height, {}};
  image.pixels.reserve(pixels);
  for (std::size_t i = 0; i < pixels; ++i) image.pixels.push_back(pixel_color(map, i, summary.top));
  append_legend(image, map.title, summary);
  return image;
}

}  // namespace lamp::app
