// Shares to colours, sums to words.
// SPDX-License-Identifier: Apache-2.0
#include "render/leak_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "image/font_5x7.h"
#include "render/legend_strip.h"

namespace lamp::app {
namespace {

/// Greys leave room below them for black and above them for white, which a palette may have for leaks.
constexpr float DARKEST = 40.0F;
constexpr float BRIGHTEST = 150.0F;
constexpr std::uint8_t SKY_GREY = 28;

/// Of the legend, in pixels of the font.
constexpr auto LINE = static_cast<std::int32_t>(LINE_ADVANCE);
constexpr std::int32_t BAR_WIDTH = 40;
constexpr std::int32_t BAR_HEIGHT = 7;

double shown(const gpu::ShadowLeak& pixel) {
  return std::max(double{pixel.arriving} - double{pixel.lost} + double{pixel.leaked}, 0.0);
}

std::uint8_t grey_of(glm::u8vec4 color) {
  return static_cast<std::uint8_t>(std::lround(DARKEST + (BRIGHTEST - DARKEST) * (luma(color) / 255.0F)));
}

/// A line of the legend.
struct Line {
  std::string words;
  glm::u8vec3 color = LegendStrip::BRIGHT;        ///< of the words
  std::optional<glm::u8vec3> bar = std::nullopt;  ///< from no light to all of it, as its shares are coloured
};

std::int32_t words_left(const Line& line, std::int32_t scale) {
  return LegendStrip::PAD * scale + (line.bar ? (BAR_WIDTH + LegendStrip::PAD) * scale : 0);
}

void draw_line(const LegendStrip& strip, std::int32_t y, const Line& line) {
  const std::int32_t width = line.bar ? BAR_WIDTH * strip.scale : 0;
  for (std::int32_t x = 0; x < width; ++x) {
    const float part = static_cast<float>(x) / static_cast<float>(width - 1);
    const glm::vec3 mixed = glm::mix(glm::vec3(DARKEST), glm::vec3(*line.bar), part);
    strip.rect(strip.left() + x, y, {1, BAR_HEIGHT * strip.scale}, glm::u8vec3(mixed + 0.5F));
  }
  const std::int32_t left = words_left(line, strip.scale);
  strip.text(left, y, fitting(line.words, strip.right() - left, strip.scale), line.color);
}

/// Letters as large as the picture allows for, or smaller where words are long.
void draw_legend(LdrImage& image, const LeakMap& map) {
  if (image.width < LEGEND_MIN_WIDTH) return;
  const LeakSums sums = sum_of(map.pixels);
  const LeakColors colors;
  std::vector<Line> lines{{.words = map.title},
                          {.words = leak_words(sums), .bar = colors.leaked},
                          {.words = lost_words(sums), .bar = colors.lost}};
  if (const std::string left_out = left_out_words(sums); !left_out.empty())
    lines.push_back({.words = left_out, .color = LegendStrip::QUIET});
  std::int32_t scale = legend_scale(image.width);
  const auto is_long = [&](const Line& line) {
    return words_left(line, scale) + text_width(line.words, scale) + LegendStrip::PAD * scale >
           static_cast<std::int32_t>(image.width);
  };
  while (scale > 1 && std::ranges::any_of(lines, is_long)) --scale;
  const auto count = static_cast<std::int32_t>(lines.size());
  const LegendStrip strip = append_strip(image, 2 * LegendStrip::PAD + LINE * count, scale);
  for (std::int32_t i = 0; i < count; ++i)
    draw_line(strip, LegendStrip::PAD + LINE * i, lines[static_cast<std::size_t>(i)]);
}

}  // namespace

std::vector<std::uint8_t> grey_of(std::span<const gpu::ShadowLeak> pixels) {
  double sum = 0.0;
  std::size_t lit = 0;
  for (const gpu::ShadowLeak& pixel : pixels) {
    sum += shown(pixel);
    lit += shown(pixel) > 0.0 ? 1 : 0;
  }
  const double mean = lit == 0 ? 1.0 : sum / static_cast<double>(lit);
  std::vector<std::uint8_t> greys;
  greys.reserve(pixels.size());
  for (const gpu::ShadowLeak& pixel : pixels) {
    const double part = shown(pixel) / (shown(pixel) + mean);  // the mean is a middle grey, and nothing is too bright
    const auto grey = static_cast<std::uint8_t>(std::lround(DARKEST + (BRIGHTEST - DARKEST) * part));
    greys.push_back(pixel.found == gpu::LEAK_SKY ? SKY_GREY : grey);
  }
  return greys;
}

glm::u8vec3 leak_color(const gpu::ShadowLeak& pixel, std::uint8_t grey, const LeakColors& colors) {
  if (pixel.found == gpu::LEAK_ENDED) return colors.unknown;
  const float all = pixel.arriving + pixel.stopped;
  if (pixel.found == gpu::LEAK_SKY || !(all > 0.0F)) return glm::u8vec3(grey);
  const float leaked = std::sqrt(std::clamp(pixel.leaked / all, 0.0F, 1.0F));
  const float lost = std::sqrt(std::clamp(pixel.lost / all, 0.0F, 1.0F));
  const float together = std::max(leaked + lost, 1.0F);
  const glm::vec3 rest(static_cast<float>(grey) * std::max(1.0F - leaked - lost, 0.0F));
  const glm::vec3 mixed = rest + (glm::vec3(colors.leaked) * leaked + glm::vec3(colors.lost) * lost) / together;
  return glm::u8vec3(mixed + 0.5F);
}

std::string leak_words(const LeakSums& sums) {
  return fmt::format("leaks: {:.2f} % of the light that rays stop", 100.0 * sums.light.leaks());
}

std::string lost_words(const LeakSums& sums) {
  return fmt::format("false shadows: {:.2f} % of the light that arrives", 100.0 * sums.light.false_shadows());
}

std::string left_out_words(const LeakSums& sums) {
  std::string words;
  if (sums.unclear != 0) words = fmt::format("left out: {} unclear pairs of pixel and light", sums.unclear);
  if (sums.ended != 0)
    words += fmt::format("{}{} pixels whose search the device ended", words.empty() ? "left out: " : ", ", sums.ended);
  return words;
}

LdrImage draw_leak_map(const LeakMap& map) {
  const std::size_t pixels = std::size_t{map.width} * map.height;
  assert(map.pixels.size() == pixels && "give light for every pixel");
  assert((map.overlay == nullptr || map.overlay->pixels.size() == pixels) && "overlay a picture of the map's size");
  const std::vector<std::uint8_t> greys = map.overlay == nullptr ? grey_of(map.pixels) : std::vector<std::uint8_t>();
  LdrImage image{map.width, map.height, {}};
  image.pixels.reserve(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const std::uint8_t grey = map.overlay == nullptr ? greys[i] : grey_of(map.overlay->pixels[i]);
    image.pixels.emplace_back(leak_color(map.pixels[i], grey, {}), 255);
  }
  draw_legend(image, map);
  return image;
}

}  // namespace lamp::app
