// The legend of a heat map, below the picture: a line of text, the colour bar, its numbers.
// SPDX-License-Identifier: Apache-2.0
#include "render/heatmap_legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string_view>
#include <vector>

#include "image/font_5x7.h"
#include "render/heatmap.h"
#include "render/legend_strip.h"

namespace lamp::app {
namespace {

/// Vertical measures in font pixels.
constexpr std::int32_t BAR_TOP = LegendStrip::PAD + static_cast<std::int32_t>(GLYPH_HEIGHT) + 3;
constexpr std::int32_t BAR_HEIGHT = 7;
constexpr std::int32_t TICK_HEIGHT = 2;
constexpr std::int32_t LABEL_TOP = BAR_TOP + BAR_HEIGHT + TICK_HEIGHT + 1;
constexpr std::int32_t STRIP_HEIGHT = LABEL_TOP + 7 + LegendStrip::PAD;
constexpr std::int32_t SIGNAL_HEIGHT = BAR_HEIGHT + LegendStrip::PAD;

/// Mean and maximum, in as many words as there is room for.
std::string numbers_line(const HeatSummary& summary, std::int32_t room, std::int32_t scale) {
  const std::string numbers =
      fmt::format("mean {:.{}f}, max {}", summary.mean, summary.mean < 10.0 ? 2 : 1, summary.max);
  const std::string sentence = fmt::format("{} {}", numbers, summary.unit);
  return text_width(sentence, scale) <= room ? sentence : numbers;
}

void draw_title(const LegendStrip& strip, std::string title, const HeatSummary& summary) {
  const std::int32_t gap = 2 * static_cast<std::int32_t>(GLYPH_ADVANCE) * strip.scale;
  const std::int32_t width = strip.right() - strip.left();
  const std::string numbers = numbers_line(summary, width - text_width(title, strip.scale) - gap, strip.scale);
  const std::int32_t numbers_x = strip.right() - text_width(numbers, strip.scale);
  const std::int32_t room = numbers_x - gap - strip.left();
  strip.text(strip.left(), LegendStrip::PAD, fitting(std::move(title), room, strip.scale), LegendStrip::BRIGHT);
  strip.text(numbers_x, LegendStrip::PAD, numbers, LegendStrip::QUIET);
}

/// The numbers of the scale: powers of two, every n-th so that labels keep apart, and the top.
std::vector<std::uint32_t> ticks(std::uint32_t top, std::int32_t bar_width, std::int32_t label_width) {
  std::vector<std::uint32_t> values;
  const double octaves = std::max<double>(std::bit_width(top) - 1, 1.0);
  const double fitting = std::max(static_cast<double>(bar_width) / label_width, 1.0);
  const auto step = static_cast<std::uint32_t>(std::max(1.0, std::ceil(octaves / fitting)));
  for (std::uint32_t power = 0; power < 32 && (1U << power) < top; power += step) values.push_back(1U << power);
  const auto from_top = [&](std::uint32_t value) { return (1.0 - heat_position(value, top)) * bar_width; };
  while (!values.empty() && from_top(values.back()) < label_width) values.pop_back();
  values.push_back(top);
  return values;
}

void draw_tick(const LegendStrip& strip, std::int32_t x, const std::string& label) {
  strip.rect(x, BAR_TOP + BAR_HEIGHT, glm::ivec2(1, TICK_HEIGHT) * strip.scale, LegendStrip::QUIET);
  strip.text(x - (text_width(label, strip.scale) - strip.scale) / 2, LABEL_TOP, label, LegendStrip::QUIET);
}

void draw_scale(const LegendStrip& strip, const HeatSummary& summary) {
  const std::int32_t scale = strip.scale;
  const std::string top_label = fmt::format("{}{}", summary.top, summary.max > summary.top ? "+" : "");
  const std::int32_t zero_width = 8 * scale;
  strip.rect(strip.left(), BAR_TOP, {zero_width, BAR_HEIGHT * scale}, LegendStrip::QUIET);
  strip.rect(strip.left() + scale, BAR_TOP + 1, {zero_width - 2 * scale, (BAR_HEIGHT - 2) * scale},
             heat_color(0, summary.top));
  draw_tick(strip, strip.left() + (zero_width - scale) / 2, "0");

  const std::int32_t bar_left = strip.left() + zero_width + 8 * scale;
  const std::int32_t bar_width = strip.right() - text_width(top_label, scale) / 2 - bar_left;
  for (std::int32_t x = 0; x < bar_width; ++x) {
    const double position = summary.top <= 1 ? 1.0 : static_cast<double>(x) / (bar_width - 1);
    strip.rect(bar_left + x, BAR_TOP, {1, BAR_HEIGHT * scale}, heat_ramp(position));
  }
  const std::int32_t label_width = text_width(top_label, scale) + 2 * scale;
  for (const std::uint32_t value : ticks(summary.top, bar_width, label_width)) {
    const auto x = static_cast<std::int32_t>(heat_position(value, summary.top) * (bar_width - scale));
    draw_tick(strip, bar_left + x, value == summary.top ? top_label : fmt::format("{}", value));
  }
}

/// A line for each colour beside the scale.
void draw_signals(const LegendStrip& strip, const HeatSummary& summary) {
  std::int32_t at = STRIP_HEIGHT;
  for (const auto& [color, meaning] : summary.signals) {
    strip.rect(strip.left(), at, glm::ivec2(8, BAR_HEIGHT) * strip.scale, color);
    strip.text(strip.left() + 12 * strip.scale, at, meaning, LegendStrip::BRIGHT);
    at += SIGNAL_HEIGHT;
  }
}

}  // namespace

void append_legend(LdrImage& image, const std::string& title, const HeatSummary& summary) {
  if (image.width < LEGEND_MIN_WIDTH) return;
  const std::int32_t signals = static_cast<std::int32_t>(summary.signals.size()) * SIGNAL_HEIGHT;
  const LegendStrip strip = append_strip(image, STRIP_HEIGHT + signals, legend_scale(image.width));
  draw_title(strip, title, summary);
  draw_scale(strip, summary);
  draw_signals(strip, summary);
}

}  // namespace lamp::app
