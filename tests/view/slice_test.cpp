// Slices and bins of depth against what pixels walk.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "render/slice_walk.h"
#include "view/depth_bins.h"
#include "view/stage.h"
#include "view/view_test.h"

namespace lamp::app {
namespace {

/// A slice through a surface's depth brings what the surface's pixel walks.
TEST(Slices, HoldWhatSurfacesWalk) {
  Request request = small_viewer().state.request;
  request.lights = 200;
  const lamp::app::Setup setup = make_setup(request);
  Session session(request, setup);
  for (const char* method : {"clustered", "drobot-zbin", "world-cells"}) {
    Lighting lighting = session.lighting(parse_method(method), {}, ShadingPath::deferred);
    static_cast<void>(session.renderer().relight(lighting));
    const std::vector<float> depth = session.renderer().read_depth();
    const std::vector<Visit> walked = session.renderer().visit_all(lighting);
    for (const std::size_t pixel : {96 * 30 + 5, 96 * 40 + 48, 96 * 53 + 90}) {
      const auto z = static_cast<float>(setup.view.z_view(depth[pixel]));
      const Visit found = visit_at(session.renderer(), lighting, z)[pixel];
      EXPECT_EQ(found.visited, walked[pixel].visited) << method;
      EXPECT_EQ(found.hash, walked[pixel].hash) << method;
      EXPECT_EQ(found.cell, walked[pixel].cell) << method;
    }
  }
}

TEST(Bins, HoldWhatPixelsWalk) {
  HeadlessInfo info = small_viewer();
  ViewState& state = info.state;
  state.request.method = "drobot-zbin";
  state.request.lights = 500;
  state.depth_bins = true;
  state.list_lengths = true;
  const ShaderLibrary shaders("");
  Stage stage(view_context(), shaders, "");
  for (const char* bins : {"8096", "7"}) {
    state.request.options = {std::string("bins=") + bins};
    const Shown shown = stage.draw(state, {96, 54});
    ASSERT_TRUE(shown.bins);
    std::uint32_t longest = 0;
    for (std::uint32_t x = 0; x < 96; ++x)
      for (std::uint32_t y = 0; y < 54; ++y)
        if (const auto bin = shown.bins->bin_at({x, y})) longest = std::max(longest, shown.bins->bins[*bin].length());
    EXPECT_GE(longest, shown.first.lengths.back().low);
    for (const BinRanks& ranks : shown.bins->bins)
      if (ranks.length() != 0) {
        ASSERT_LT(ranks.greatest, shown.bins->lights);
      }
  }
}

TEST(Bins, AreDecodedAndShareColumns) {
  const std::uint32_t narrow[] = {0x00050002U, 0x0000FFFFU, 0x00070007U};
  const std::vector<BinRanks> bins = decode_bins(narrow, false);
  EXPECT_EQ(bins[0], (BinRanks{2, 5}));
  EXPECT_EQ(bins[0].length(), 4U);
  EXPECT_EQ(bins[1].length(), 0U);
  const std::uint32_t wide[] = {2, 5, ~0U, 0};
  EXPECT_EQ(decode_bins(wide, true)[0], bins[0]);
  EXPECT_EQ(used_bins(std::span(bins).first(2)), 1U);
  EXPECT_EQ(bin_columns(bins, 1)[0].all, (BinRanks{2, 7}));
  EXPECT_EQ(bin_columns(bins, 1)[0].longest, 4U);
  const std::vector<BinColumn> stretched = bin_columns(bins, 6);
  EXPECT_EQ(stretched[1].all, bins[0]);
  EXPECT_EQ(stretched[2].longest, 0U);
  EXPECT_EQ(stretched[5].all, bins[2]);
}

}  // namespace
}  // namespace lamp::app
