// Heat map: order of its colours, scale, legend.
// SPDX-License-Identifier: Apache-2.0
#include "render/heatmap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "render/heatmap_legend.h"
#include "render/legend_strip.h"

namespace lamp::app {
namespace {

double luminance(glm::u8vec3 color) {
  const auto linear = [](std::uint8_t byte) {
    const double encoded = byte / 255.0;
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(color.r) + 0.7152 * linear(color.g) + 0.0722 * linear(color.b);
}

/// The picture's rows below the map.
std::vector<glm::u8vec4> legend(const LdrImage& image, std::uint32_t map_height) {
  return {image.pixels.begin() + static_cast<std::ptrdiff_t>(std::size_t{image.width} * map_height),
          image.pixels.end()};
}

LdrImage draw(std::uint32_t width, std::uint32_t height, std::span<const std::uint32_t> counts,
              const std::string& title = "tiled", std::uint32_t scale_max = 0) {
  return draw_heatmap({.width = width, .height = height, .counts = counts, .scale_max = scale_max, .title = title});
}

// The ends of a title tell methods and their options apart.
TEST(Legend, TitlesAreCutInTheMiddle) {
  const std::string title = "tiled - clustered";
  EXPECT_EQ(fitting(title, text_width(title, 2), 2), title);
  EXPECT_EQ(fitting(title, text_width(title, 2) - 1, 2), "tiled -..ustered");
  EXPECT_EQ(fitting(title, text_width("tile..red", 1), 1), "tile..red");
  EXPECT_EQ(fitting(title, 0, 1), "..");
}

TEST(HeatColor, MoreLightsAreLighter) {
  EXPECT_EQ(heat_color(0, 64), glm::u8vec3(0));
  for (const std::uint32_t top : {2U, 64U, 100U, 4096U}) {
    double before = luminance(heat_color(0, top));
    for (std::uint32_t count = 1; count <= top; count *= 2) {
      const double now = luminance(heat_color(count, top));
      EXPECT_GT(now, before) << count << " of " << top;
      before = now;
    }
  }
  double before = -1.0;
  for (int step = 0; step <= 1000; ++step) {
    const double now = luminance(heat_ramp(step / 1000.0));
    ASSERT_GE(now, before - 0.002) << step;  // eight bits round
    before = std::max(before, now);
  }
}

TEST(HeatColor, ScaleIsLogarithmicAndEndsAtItsTop) {
  EXPECT_EQ(heat_position(1, 256), 0.0);
  EXPECT_DOUBLE_EQ(heat_position(2, 256), 0.125);
  EXPECT_DOUBLE_EQ(heat_position(16, 256), 0.5);
  EXPECT_EQ(heat_position(256, 256), 1.0);
  EXPECT_EQ(heat_color(100000, 256), heat_color(256, 256));
  EXPECT_EQ(heat_color(1, 1), heat_color(256, 256));
  EXPECT_EQ(heat_color(0xFFFFFFFE, 0xFFFFFFFE), heat_color(1, 1));
}

TEST(DrawHeatmap, PixelsHaveTheColorOfTheirCount) {
  const std::array<std::uint32_t, 4> counts{0, 3, 16, SKY_CELL};
  const LdrImage image = draw(2, 2, counts);
  ASSERT_EQ(image.pixels.size(), 4U);  // too small for a legend
  EXPECT_EQ(glm::u8vec3(image.pixels[0]), glm::u8vec3(0));
  EXPECT_EQ(glm::u8vec3(image.pixels[1]), heat_color(3, 16));
  EXPECT_EQ(glm::u8vec3(image.pixels[2]), heat_color(16, 16));
  EXPECT_GT(luminance(glm::u8vec3(image.pixels[3])), 0.0);
  EXPECT_LT(luminance(glm::u8vec3(image.pixels[3])), 0.05);
}

TEST(DrawHeatmap, WhatIsNoNumberHasItsColourAndALine) {
  const HeatSignal signals[] = {{.count = 7, .color = {1, 2, 3}, .meaning = "late"},
                                {.count = 9, .color = {4, 5, 6}, .meaning = "of no pixel"}};
  std::vector<std::uint32_t> counts(std::size_t{240} * 2, 4);
  counts[1] = 7;
  const Heatmap plain{.width = 240, .height = 2, .counts = counts, .title = "t"};
  Heatmap map = plain;
  map.signals = signals;
  const LdrImage image = draw_heatmap(map);
  EXPECT_EQ(glm::u8vec3(image.pixels[1]), glm::u8vec3(1, 2, 3));
  EXPECT_EQ(glm::u8vec3(image.pixels[0]), heat_color(4, 4)) << "7 is of no scale";
  const std::uint32_t without = draw_heatmap(plain).height;
  EXPECT_GT(image.height, without) << "one line more";
  const std::vector<glm::u8vec4> rows = legend(image, 2);
  EXPECT_NE(std::ranges::find(rows, glm::u8vec4(1, 2, 3, 255)), rows.end());
  EXPECT_EQ(std::ranges::find(rows, glm::u8vec4(4, 5, 6, 255)), rows.end());
}

TEST(DrawHeatmap, AutomaticTopIsTheNextPowerOfTwo) {
  for (const auto& [max, top] : {std::pair{0U, 2U}, {1U, 2U}, {16U, 16U}, {17U, 32U}, {1000U, 1024U}}) {
    const std::array<std::uint32_t, 2> counts{1, max};
    EXPECT_EQ(glm::u8vec3(draw(2, 1, counts).pixels[1]), heat_color(max, top)) << max;
  }
}

TEST(DrawHeatmap, LegendIsBelowAndHidesNothing) {
  for (const glm::uvec2 size : {glm::uvec2(200, 10), glm::uvec2(640, 360), glm::uvec2(1920, 108)}) {
    const std::vector<std::uint32_t> counts(std::size_t{size.x} * size.y, 5);
    const LdrImage image = draw(size.x, size.y, counts);
    EXPECT_EQ(image.width, size.x);
    ASSERT_GT(image.height, size.y + 20);
    ASSERT_EQ(image.pixels.size(), std::size_t{image.width} * image.height);
    for (std::size_t i = 0; i < counts.size(); ++i) ASSERT_EQ(glm::u8vec3(image.pixels[i]), heat_color(5, 8)) << i;
    std::set<std::array<std::uint8_t, 3>> colors;
    for (const glm::u8vec4 pixel : legend(image, size.y)) colors.insert({pixel.r, pixel.g, pixel.b});
    EXPECT_GT(colors.size(), 100U);  // the whole ramp is there
    EXPECT_TRUE(colors.contains({255, 240, 231}));
  }
  const std::vector<std::uint32_t> counts(std::size_t{LEGEND_MIN_WIDTH - 1} * 4, 5);
  EXPECT_EQ(draw(LEGEND_MIN_WIDTH - 1, 4, counts).height, 4U);
}

TEST(DrawHeatmap, LegendShowsTitleScaleAndNumbers) {
  std::vector<std::uint32_t> counts(std::size_t{640} * 4, 5);
  const std::vector<glm::u8vec4> plain = legend(draw(640, 4, counts), 4);
  EXPECT_EQ(legend(draw(640, 4, counts), 4), plain);
  EXPECT_NE(legend(draw(640, 4, counts, "tiles"), 4), plain);
  EXPECT_NE(legend(draw(640, 4, counts, "tiled", 16), 4), plain);
  EXPECT_NE(legend(draw(640, 4, counts, "tiled", 2), 4),
            legend(draw(640, 4, std::vector(counts.size(), 2U), "tiled", 2), 4));
  std::vector<std::uint32_t> sky = counts;
  sky[0] = SKY_CELL;  // changes neither mean nor maximum
  EXPECT_EQ(legend(draw(640, 4, sky), 4), plain);
  sky[0] = 8;
  EXPECT_NE(legend(draw(640, 4, sky), 4), plain);
}

TEST(DrawHeatmap, OddMapsHaveLegendsToo) {
  const std::string long_title(500, 'x');
  const std::vector<std::uint32_t> sky(std::size_t{300} * 2, SKY_CELL);
  EXPECT_GT(draw(300, 2, sky, long_title).height, 2U);
  for (const std::uint32_t count : {0U, 1U, 99999U, SKY_CELL - 1}) {
    for (const std::uint32_t top : {0U, 1U, 3U, 100U, SKY_CELL}) {
      const std::vector<std::uint32_t> counts(std::size_t{250} * 2, count);
      const LdrImage image = draw(250, 2, counts, "", top);
      EXPECT_GT(image.height, 2U);
    }
  }
}

TEST(DrawHeatmap, OverlayShowsMapAndPicture) {
  const std::array<std::uint32_t, 4> counts{4, 4, 1, SKY_CELL};
  const LdrImage below{4, 1, {{0, 0, 0, 255}, {250, 250, 250, 255}, {0, 0, 0, 255}, {200, 100, 50, 255}}};
  const LdrImage image =
      draw_heatmap({.width = 4, .height = 1, .counts = counts, .scale_max = 4, .title = "", .overlay = &below});
  EXPECT_LT(luminance(glm::u8vec3(image.pixels[0])), luminance(glm::u8vec3(image.pixels[1])));
  EXPECT_LT(luminance(glm::u8vec3(image.pixels[2])), luminance(glm::u8vec3(image.pixels[0])));
  EXPECT_EQ(image.pixels[3], glm::u8vec4(60, 30, 15, 255));
}

}  // namespace
}  // namespace lamp::app
