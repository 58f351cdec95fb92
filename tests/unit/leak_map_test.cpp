// Leaks in colour: what a share of light looks like, what counts in the sums, and the legend.
// SPDX-License-Identifier: Apache-2.0
#include "render/leak_map.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace lamp::app {
namespace {

constexpr gpu::ShadowLeak SKY{.found = gpu::LEAK_SKY};
const LeakColors COLORS;

int distance(glm::u8vec3 a, glm::u8vec3 b) {
  const glm::ivec3 apart = glm::abs(glm::ivec3(a) - glm::ivec3(b));
  return apart.x + apart.y + apart.z;
}

TEST(LeakColor, IsGreyWhereTheFilterIsRight) {
  for (const gpu::ShadowLeak& right : {gpu::ShadowLeak{.arriving = 1.0F, .stopped = 2.0F}, gpu::ShadowLeak{}, SKY})
    EXPECT_EQ(leak_color(right, 77, COLORS), glm::u8vec3(77));
}

TEST(LeakColor, ComesNearerToTheFullColourWithTheShare) {
  EXPECT_EQ(leak_color({.stopped = 3.0F, .leaked = 3.0F}, 77, COLORS), COLORS.leaked);
  EXPECT_EQ(leak_color({.arriving = 3.0F, .lost = 3.0F}, 77, COLORS), COLORS.lost);
  int leaked_before = distance(glm::u8vec3(77), COLORS.leaked);
  int lost_before = distance(glm::u8vec3(77), COLORS.lost);
  for (const float share : {0.01F, 0.1F, 0.3F, 0.6F, 1.0F}) {
    const int leaked = distance(leak_color({.stopped = 1.0F, .leaked = share}, 77, COLORS), COLORS.leaked);
    const int lost = distance(leak_color({.arriving = 1.0F, .lost = share}, 77, COLORS), COLORS.lost);
    EXPECT_LT(leaked, leaked_before) << share;
    EXPECT_LT(lost, lost_before) << share;
    leaked_before = leaked;
    lost_before = lost;
  }
}

TEST(LeakColor, IsOfTheWholeLightOfThePixel) {
  // A quarter of the stopped light leaks, which is a sixteenth of all: a quarter of the way.
  const glm::u8vec3 color =
      leak_color({.arriving = 12.0F, .stopped = 4.0F, .leaked = 1.0F}, 80, {.leaked = glm::u8vec3(240)});
  EXPECT_EQ(color, glm::u8vec3(120));
}

TEST(LeakColor, MixesBothAndMarksWhatIsNotKnown) {
  const LeakColors plain{.leaked = {200, 0, 0}, .lost = {0, 0, 200}};
  EXPECT_EQ(leak_color({.arriving = 1.0F, .stopped = 1.0F, .leaked = 1.0F, .lost = 1.0F}, 77, plain),
            glm::u8vec3(100, 0, 100));
  EXPECT_EQ(leak_color({.found = gpu::LEAK_ENDED}, 77, COLORS), COLORS.unknown);
}

TEST(LeakGrey, IsDarkestInTheSkyAndRisesWithLight) {
  const std::vector<gpu::ShadowLeak> pixels{SKY, {}, {.arriving = 1.0F}, {.arriving = 9.0F}};
  const std::vector<std::uint8_t> greys = grey_of(pixels);
  for (std::size_t i = 1; i < greys.size(); ++i) EXPECT_GT(greys[i], greys[i - 1]);
  EXPECT_LT(greys.back(), 200) << "there is room for white";
  EXPECT_EQ(grey_of(std::vector<gpu::ShadowLeak>{{.stopped = 5.0F, .leaked = 5.0F}, {.arriving = 5.0F}}),
            (std::vector<std::uint8_t>(2, grey_of(std::vector<gpu::ShadowLeak>{{.arriving = 5.0F}}).front())));
}

TEST(LeakSum, LeavesOutWhatIsNotKnown) {
  const std::vector<gpu::ShadowLeak> pixels{
      SKY,
      {.arriving = 8.0F, .stopped = 4.0F, .leaked = 1.0F, .lost = 2.0F, .unclear = 3},
      {.arriving = 100.0F, .lost = 50.0F, .unclear = 7, .found = gpu::LEAK_ENDED},
      {.stopped = 1.0F}};
  const LeakSums sums = sum_of(pixels);
  EXPECT_EQ(
      sums,
      (LeakSums{.light = {.arriving = 8.0, .stopped = 5.0, .leaked = 1.0, .lost = 2.0}, .unclear = 3, .ended = 1}));
  EXPECT_EQ(leak_words(sums), "leaks: 20.00 % of the light that rays stop");
  EXPECT_EQ(lost_words(sums), "false shadows: 25.00 % of the light that arrives");
  EXPECT_EQ(left_out_words(sums),
            "left out: 3 unclear pairs of pixel and light, 1 pixels whose search the device ended");
  EXPECT_EQ(left_out_words({.ended = 2}), "left out: 2 pixels whose search the device ended");
  EXPECT_EQ(left_out_words({}), "");
  EXPECT_EQ(leak_words({}), "leaks: 0.00 % of the light that rays stop");
}

TEST(LeakMapPicture, HasALineOfLegendForWhatIsLeftOut) {
  std::vector<gpu::ShadowLeak> pixels(std::size_t{240} * 4, {.arriving = 1.0F});
  pixels[5] = {.stopped = 1.0F, .leaked = 1.0F};
  LeakMap map{.width = 240, .height = 4, .pixels = pixels, .title = "vsm"};
  const LdrImage image = draw_leak_map(map);
  EXPECT_EQ(image.width, 240U);
  EXPECT_EQ(glm::u8vec3(image.pixels[5]), COLORS.leaked);
  EXPECT_EQ(image.pixels[6].r, image.pixels[6].g);
  const auto has = [&](glm::u8vec3 color) {
    return std::ranges::find(image.pixels.begin() + 4 * 240, image.pixels.end(), glm::u8vec4(color, 255)) !=
           image.pixels.end();
  };
  EXPECT_TRUE(has(COLORS.leaked));
  EXPECT_TRUE(has(COLORS.lost));
  pixels[7].unclear = 1;
  EXPECT_GT(draw_leak_map(map).height, image.height);
  const LdrImage below{240, 4, std::vector<glm::u8vec4>(std::size_t{240} * 4, {255, 255, 255, 255})};
  map.overlay = &below;
  const LdrImage over = draw_leak_map(map);
  EXPECT_EQ(glm::u8vec3(over.pixels[5]), COLORS.leaked);
  EXPECT_EQ(glm::u8vec3(over.pixels[6]), glm::u8vec3(150)) << "a white picture is the brightest grey";
}

}  // namespace
}  // namespace lamp::app
