// Shares to colours, sums to words.
// SPDX-License-Identifier: Apache-2.0
#include "render/leak_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

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

/// A bar from no light to all of it, as its shares are coloured, and what it means.
void draw_bar(const LegendStrip& strip, std::int32_t line, glm::u8vec3 color, const std::string& words) {
  const std::int32_t width = BAR_WIDTH * strip.scale;
  for (std::int32_t x = 0; x < width; ++x) {
    const float part = static_cast<float>(x) / static_cast<float>(width - 1);
    const glm::vec3 mixed = glm::mix(glm::vec3(DARKEST), glm::vec3(color), part);
    strip.rect(strip.left() + x, LegendStrip::PAD + LINE * line, {1, BAR_HEIGHT * strip.scale},
               glm::u8vec3(mixed + 0.5F));
  }
  strip.text(strip.left() + width + LegendStrip::PAD * strip.scale, LegendStrip::PAD + LINE * line, words,
             LegendStrip::BRIGHT);
}

void draw_legend(LdrImage& image, const LeakMap& map) {
  if (image.width < LEGEND_MIN_WIDTH) return;
  const LeakSums sums = sum_of(map.pixels);
  const std::string left_out = left_out_words(sums);
  const LegendStrip strip = append_strip(image, 2 * LegendStrip::PAD + LINE * (left_out.empty() ? 3 : 4));
  const LeakColors colors;
  strip.text(strip.left(), LegendStrip::PAD, map.title, LegendStrip::BRIGHT);
  draw_bar(strip, 1, colors.leaked, leak_words(sums));
  draw_bar(strip, 2, colors.lost, lost_words(sums));
  if (!left_out.empty()) strip.text(strip.left(), LegendStrip::PAD + LINE * 3, left_out, LegendStrip::QUIET);
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
