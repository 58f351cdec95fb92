// What overlays say of walks that are known; dynamic resolution; percentiles.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "commands/pictures.h"
#include "render/heatmap.h"
#include "render/shaders/shadow_heat_data.h"
#include "view/overlay.h"
#include "view/pace.h"
#include "view/shadow_overlay.h"
#include "view/times.h"

namespace lamp::app {
namespace {

View small_view() {
  const auto view = View::create(2, 2, perspective(symmetric_window(1.0, 1.0), 0.1, INFINITE_FAR), glm::dmat4(1.0));
  return view.value();
}

std::uint32_t alpha(std::uint32_t pixel) { return pixel >> 24U; }
glm::u8vec3 color(std::uint32_t pixel) { return {pixel & 255U, pixel >> 8U & 255U, pixel >> 16U & 255U}; }

/// Sky, and two cells: one of two pixels.
const std::vector<Visit> VISITS{
    {.cell = SKY_CELL}, {.visited = 3, .cell = 5}, {.visited = 9, .cell = 6}, {.visited = 3, .cell = 5}};
// 0.1 m over the depth is how far ahead the surface is.
const std::vector<float> DEPTH{0.0F, 0.1F, 0.05F, 0.02F};

TEST(Overlays, HeatHasTheColoursOfHeatMaps) {
  const View view = small_view();
  const Overlaid made = make_overlay(Overlay::heat, Palette::rainbow, {.view = view, .visits = VISITS});
  EXPECT_EQ(made.legend.high, 16.0);
  EXPECT_EQ(made.legend.max, 9.0);
  EXPECT_EQ(made.legend.mean, 5.0);
  EXPECT_EQ(color(made.pixels[1]), heat_color(3, 16));
  EXPECT_EQ(color(made.pixels[2]), heat_color(9, 16));
}

TEST(Overlays, CellsDiffer) {
  const View view = small_view();
  const Overlaid made = make_overlay(Overlay::cells, Palette::rainbow, {.view = view, .visits = VISITS});
  EXPECT_EQ(made.pixels[1], made.pixels[3]);
  EXPECT_NE(made.pixels[1], made.pixels[2]);
  EXPECT_EQ(made.legend.cells, 2);
}

/// Neighbours in a row and in a column, whatever the number of cells in a row: golden steps made stripes of 55.
TEST(Overlays, NeighbouringCellsDiffer) {
  for (std::uint32_t across = 1; across < 100; ++across) {
    int alike = 0;
    for (std::uint32_t cell = 0; cell < 1000; ++cell) {
      const glm::vec3 step = glm::vec3(cell_color(cell)) - glm::vec3(cell_color(cell + across));
      alike += glm::dot(step, step) < 30.0F * 30.0F ? 1 : 0;
    }
    EXPECT_LT(alike, 60) << across << " cells a row";
  }
}

TEST(Overlays, DepthRangeIsFromNearestToFarthest) {
  const View view = small_view();
  const Overlaid made =
      make_overlay(Overlay::depth_range, Palette::grey, {.view = view, .visits = VISITS, .depth = DEPTH});
  EXPECT_NEAR(made.legend.max, 4.0, 1e-4);
  EXPECT_NEAR(made.legend.mean, 2.0, 1e-4);
  EXPECT_EQ(color(made.pixels[1]), glm::u8vec3(255));
  EXPECT_EQ(color(made.pixels[2]), glm::u8vec3(20));
}

TEST(Overlays, OverflowMarksPixelsThatWalkEverything) {
  const View view = small_view();
  Walked walked{.view = view, .visits = VISITS, .lights = 9, .overflowed = true};
  EXPECT_EQ(make_overlay(Overlay::overflow, Palette::grey, walked).legend.cells, 1);
  walked.overflowed = false;
  EXPECT_EQ(make_overlay(Overlay::overflow, Palette::grey, walked).legend.cells, 0);
}

TEST(Overlays, MissedMarksPixelsThatLackALight) {
  const View view = small_view();
  std::vector<Visit> visits = VISITS;
  visits[2].missed = 3;
  const Overlaid made = make_overlay(Overlay::missed, Palette::grey, {.view = view, .visits = visits});
  EXPECT_EQ(made.legend.cells, 1);
  EXPECT_EQ(made.legend.max, 3.0);
  EXPECT_NE(made.pixels[1], made.pixels[2]);
}

TEST(Overlays, DifferenceSaysWhichWalksMore) {
  const View view = small_view();
  std::vector<Visit> other = VISITS;
  other[1].visited = 7;
  other[2].visited = 8;
  const Overlaid made =
      make_overlay(Overlay::difference, Palette::grey, {.view = view, .visits = VISITS, .other = other});
  EXPECT_EQ(made.legend.cells, 2);
  EXPECT_EQ(made.legend.max, 4.0);
  EXPECT_EQ(made.legend.mean, -1.0);
  EXPECT_EQ(color(made.pixels[1]), SECOND_WALKS_MORE);
  EXPECT_EQ(color(made.pixels[2]), glm::u8vec3(glm::vec3(FIRST_WALKS_MORE) / 2.0F + 0.5F));
  EXPECT_EQ(color(made.pixels[3]), glm::u8vec3(0));
}

/// An atlas of 64 texels: light 1 has a square of 16 at (16, 0), all of whose surfaces are half its range away.
TEST(Overlays, ShadowAtlasShowsWhoseSquareIsWhere) {
  std::vector<float> texels(std::size_t{64} * 64, 0.0F);
  for (std::size_t y = 0; y < 16; ++y)
    for (std::size_t x = 16; x < 32; ++x) texels[x + 64 * y] = 0.2F;  // near / w, with w = 0.5 m
  const std::vector<shared::ShadowMap> maps{
      {}, {.kind = shared::SHADOW_SPOT, .near_m = 0.1F, .range_m = 1.0F, .side = 16, .squares = {1}}};
  AtlasSeen seen{.texels = texels, .side = 64, .maps = maps, .picture = {80, 64}};
  const Overlaid all = make_shadow_overlay(Palette::grey, seen);
  const auto at = [](const Overlaid& made, std::size_t x, std::size_t y) { return color(made.pixels[x + 80 * y]); };
  EXPECT_EQ(all.legend.cells, 1);
  EXPECT_EQ(all.legend.max, 64.0);
  EXPECT_EQ(at(all, 2, 2), glm::u8vec3(0));  // beside the atlas
  const glm::u8vec3 half = palette_color(Palette::grey, 0.5);
  EXPECT_EQ(at(all, 8 + 24, 8), half);
  EXPECT_NE(at(all, 8 + 40, 8), half);
  seen.record = 1;
  const Overlaid one = make_shadow_overlay(Palette::grey, seen);
  EXPECT_EQ(one.legend.max, 16.0);
  EXPECT_EQ(at(one, 40, 32), half);
  EXPECT_EQ(at(one, 70, 60), half);
  seen.record = 0;  // has none: all are shown
  EXPECT_EQ(make_shadow_overlay(Palette::grey, seen).legend.max, 64.0);
}

TEST(Overlays, ShadowHeatTellsNumbersFromWhatIsNone) {
  const std::vector<std::uint32_t> worst{0, 4, 16, gpu::WITHOUT_SHADOW, gpu::WAITS_FOR_REDRAWING, gpu::SKY_CELL};
  const Overlaid made = make_shadow_heat(Overlay::shadow_age, Palette::grey, worst, 0.0);
  EXPECT_EQ(made.legend.cells, 2);
  EXPECT_EQ(made.legend.max, 16.0);
  EXPECT_NEAR(made.legend.mean, 20.0 / 3.0, 1e-9);
  EXPECT_EQ(color(made.pixels[0]), glm::u8vec3(0));
  EXPECT_EQ(color(made.pixels[1]), palette_color(Palette::grey, 0.5));
  EXPECT_EQ(color(made.pixels[2]), palette_color(Palette::grey, 1.0));
  EXPECT_EQ(color(made.pixels[3]), WITHOUT_COLOR);
  EXPECT_EQ(color(made.pixels[4]), WAITS_COLOR);
}

TEST(Overlays, ShadowLeaksHaveThePalettesColours) {
  const std::vector<gpu::ShadowLeak> pixels{{.stopped = 2.0F, .leaked = 2.0F},
                                            {.arriving = 6.0F, .lost = 3.0F},
                                            {.arriving = 1.0F},
                                            {.found = gpu::LEAK_SKY}};
  for (const Palette palette : {Palette::rainbow, Palette::blue_yellow, Palette::grey}) {
    const Overlaid made = make_shadow_leaks(palette, pixels);
    const LeakColors colors = leak_colors(palette);
    EXPECT_NE(colors.leaked, colors.lost);
    EXPECT_EQ(made.legend.overlay, Overlay::shadow_leaks);
    EXPECT_EQ(made.legend.leaks->light.leaks(), 1.0);
    EXPECT_EQ(made.legend.leaks->light.false_shadows(), 3.0 / 7.0);
    EXPECT_EQ(color(made.pixels[0]), colors.leaked);
    EXPECT_EQ(color(made.pixels[2]).r, color(made.pixels[2]).b);
    EXPECT_NE(color(made.pixels[1]).r, color(made.pixels[2]).r);
    EXPECT_EQ(alpha(made.pixels[3]), 255U);
  }
  EXPECT_EQ(leak_colors(Palette::grey).leaked, glm::u8vec3(255));
}

TEST(ListLengthsTest, CountCells) {
  EXPECT_TRUE(list_lengths({}).empty());
  const std::vector<ListLengths> expected{{0, 0, 0}, {1, 1, 0}, {2, 2, 0}, {3, 4, 1}, {5, 8, 0}, {9, 16, 1}};
  EXPECT_EQ(list_lengths(VISITS), expected);
  const std::vector<Visit> ends{{.visited = 0, .cell = 1}, {.visited = 1, .cell = 2}, {.visited = ~0U, .cell = 3}};
  EXPECT_EQ(list_lengths(ends).size(), 34U);
  EXPECT_EQ(list_lengths(ends).front().cells, 1U);
  EXPECT_EQ(list_lengths(ends).back(), (ListLengths{(1U << 31U) + 1, ~0U, 1}));
}

TEST(Overlays, DimTheSky) {
  const View view = small_view();
  for (const Overlay overlay :
       {Overlay::heat, Overlay::cells, Overlay::depth_range, Overlay::overflow, Overlay::missed}) {
    const Overlaid made = make_overlay(overlay, Palette::grey, {.view = view, .visits = VISITS, .depth = DEPTH});
    EXPECT_EQ(color(made.pixels[0]), glm::u8vec3(0));
    EXPECT_GT(alpha(made.pixels[0]), 0);
  }
}

TEST(Palettes, RiseInLightness) {
  for (const Palette palette : {Palette::rainbow, Palette::blue_yellow, Palette::grey}) {
    double last = -1.0;
    for (int i = 0; i <= 20; ++i) {
      const glm::dvec3 c(palette_color(palette, i / 20.0));
      const double luma = glm::dot(c, glm::dvec3(0.2126, 0.7152, 0.0722));
      EXPECT_GT(luma, last);
      last = luma;
    }
  }
}

TEST(PaceTest, FindsTheSizeThatIsQuickEnough) {
  Pace pace(100.0);
  for (int i = 0; i < 200; ++i) pace.took(20.0 + 900.0 * pace.scale() * pace.scale());
  EXPECT_EQ(pace.scale(), 0.25);       // 76 ms; 0.375 takes 147
  EXPECT_EQ(pace.rest_scale(), 0.75);  // 76 ms times 9; at full size, 16
  for (int i = 0; i < 200; ++i) pace.took(10.0 * pace.scale());
  EXPECT_EQ(pace.scale(), 1.0);
}

TEST(PaceTest, KeepsItsSizeThroughOneSlowPicture) {
  Pace pace(100.0);
  const double before = pace.scale();
  pace.took(1000.0);
  pace.took(90.0);
  EXPECT_EQ(pace.scale(), before);
}

TEST(TimesTest, BeginAnewWithOtherPasses) {
  Times times;
  for (int i = 1; i <= 300; ++i) times.add({.passes = {{.name = "cull", .ms_median = 1.0 * i}}, .frame_ms = 1.0 * i});
  ASSERT_EQ(times.rows().size(), 4);
  EXPECT_EQ(times.rows()[3].ms.size(), Times::MOST);
  EXPECT_NEAR(times.rows()[2].at(0.5), 180.0, 1.0);
  times.add({.passes = {{.name = "other"}}});
  EXPECT_EQ(times.rows()[3].name, "other");
  EXPECT_EQ(times.rows()[3].ms.size(), 1);
}

}  // namespace
}  // namespace lamp::app
