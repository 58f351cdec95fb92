// The cells of one light: counted and toned as walks and oracle say, for every method.
// SPDX-License-Identifier: Apache-2.0
#include "view/light_cells.h"

#include <gtest/gtest.h>

#include <set>

#include "render/pixel_lights.h"
#include "view/overlay_colors.h"
#include "view/stage.h"
#include "view/view_test.h"

namespace lamp::app {
namespace {

/// Sky, a cell that lists the light and that it reaches, one that lists it in vain, one that does not list it.
TEST(LightCells, HaveTwoTones) {
  const std::vector<Visit> visits{{.cell = gpu::SKY_CELL},
                                  {.cell = 5},
                                  {.cell = 5},
                                  {.cell = 5},
                                  {.cell = 6},
                                  {.cell = 6},
                                  {.cell = 7},
                                  {.cell = 7}};
  const std::vector<std::uint32_t> listed{0, 1, 1, 1, 1, 1, 0, 0};
  std::vector<Reach> reached(8, Reach::outside);
  reached[2] = Reach::inside;
  reached[4] = Reach::boundary;
  const Overlaid made = make_light_cells({.width = 8, .visits = visits, .listed = listed, .reached = reached});
  EXPECT_EQ(made.legend.cells, 2);
  EXPECT_EQ(made.legend.reached, 1);
  EXPECT_EQ(made.legend.lacking, 0);
  EXPECT_EQ(made.pixels[0], sky_dimmed());
  EXPECT_EQ(made.pixels[1], rgba(REACHES_A_PIXEL, 0.4F));
  EXPECT_EQ(made.pixels[2], rgba(REACHES_A_PIXEL, SIGNAL_ALPHA));
  EXPECT_EQ(made.pixels[3], rgba(REACHES_A_PIXEL / glm::u8vec3(3), 0.65F));  // an edge
  EXPECT_EQ(made.pixels[4], rgba(LISTED_IN_VAIN, 0.4F));
  EXPECT_EQ(made.pixels[6], dimmed());
  EXPECT_EQ(words_of_light_cells(made.legend, 3), "light 3: listed in 2 cells, reaches a pixel in 1 of them: 50 %");
}

TEST(LightCells, SayWhatIsMissing) {
  const std::vector<Visit> visits{{.cell = 5}, {.cell = 6}};
  const std::vector<std::uint32_t> listed{0, 0};
  const std::vector<Reach> reached{Reach::inside, Reach::outside};
  const Overlaid made = make_light_cells({.width = 2, .visits = visits, .listed = listed, .reached = reached});
  EXPECT_EQ(made.pixels[0], rgba(SIGNAL, SIGNAL_ALPHA));
  EXPECT_EQ(words_of_light_cells(made.legend, 9),
            "light 9: listed in no cell of the picture; missing in 1 cell in which it reaches a pixel");
}

/// For every method: no cell that the light reaches lacks it, and a pixel that is said to have it has it in its list.
TEST(LightCells, AreThoseOfTheLists) {
  const ShaderLibrary shaders("");
  Stage stage(view_context(), shaders, "");
  ViewState state = small_viewer().state;
  state.overlay = Overlay::light_cells;
  state.picked = glm::uvec2(48, 40);
  state.request.range = "1:2";
  std::set<std::uint64_t> counts;
  for (const Method& method : methods()) {
    state.request.method = method.name;
    state.request.path = method.name == "fused" ? "forward" : "deferred";
    state.light.reset();
    Shown shown = stage.draw(state, {96, 54});
    EXPECT_NE(shown.first.legend.refused, "");
    const auto reaching = std::ranges::find(shown.inspection->lights, Reach::inside, &ListedLight::reach);
    ASSERT_NE(reaching, shown.inspection->lights.end());
    state.light = reaching->light;
    shown = stage.draw(state, {96, 54});
    const Legend& legend = shown.first.legend;
    EXPECT_EQ(legend.refused, "") << method.name;
    EXPECT_GE(legend.reached, 1) << method.name;
    EXPECT_LE(legend.reached, legend.cells) << method.name;
    if (!shown.first.stats.approximate) {
      EXPECT_EQ(legend.lacking, 0) << method.name;
    }
    counts.insert(legend.cells);
  }
  EXPECT_GT(counts.size(), 3);
  EXPECT_TRUE(counts.contains(1));  // method all has one cell
}

TEST(LightCells, AreRefusedWithAReason) {
  const ShaderLibrary shaders("");
  Stage stage(view_context(), shaders, "");
  ViewState state = small_viewer().state;
  state.overlay = Overlay::light_cells;
  EXPECT_NE(stage.draw(state, {96, 54}).first.legend.refused.find("click a pixel"), std::string::npos);
  state.light = 9999;
  const Shown shown = stage.draw(state, {96, 54});
  EXPECT_EQ(shown.first.legend.refused,
            "there is no light 9999: the frame has " + std::to_string(shown.lights->size()));
}

}  // namespace
}  // namespace lamp::app
