// Masks of cells: what they hold, what they leave out, and the parts that a light lies beside.
// SPDX-License-Identifier: Apache-2.0
#include "view/mask_overlay.h"

#include <gtest/gtest.h>

#include <bit>

#include "render/cell_masks.h"
#include "render/pixel_lights.h"
#include "view/overlay_colors.h"
#include "view/stage.h"
#include "view/view_test.h"

namespace lamp::app {
namespace {

TEST(MaskOverlay, ShowsWhatIsEmpty) {
  const std::vector<Visit> visits{{.cell = gpu::SKY_CELL}, {.cell = 70}, {.cell = 7}, {.cell = 70}};
  const NumberedCells cells = numbered_cells(visits);
  EXPECT_EQ(cells.count, 2);
  EXPECT_EQ(cells.of_pixels, (std::vector<std::uint32_t>{gpu::NO_CELL, 0, 1, 0}));
  const std::vector<gpu::CellMask> masks{{.z_near = 1.0F, .z_far = 9.0F, .mask = 0x80000001U},
                                         {.z_near = 2.0F, .z_far = 6.0F, .mask = 0x0000FFFFU}};
  EXPECT_EQ(empty_m(masks[0]), 7.5);
  EXPECT_EQ(empty_m(masks[1]), 2.0);
  const Overlaid made = make_mask_overlay(Palette::grey, cells.of_pixels, masks, 0.0);
  EXPECT_EQ(made.legend.max, 7.5);
  EXPECT_EQ(made.legend.mean, 4.75);
  EXPECT_EQ(made.legend.low, 9.0);
  EXPECT_EQ(made.pixels[0], sky_dimmed());
  EXPECT_EQ(made.pixels[1], rgba(palette_color(Palette::grey, 1.0), MAP_ALPHA));
  EXPECT_EQ(made.pixels[2], rgba(palette_color(Palette::grey, 2.0 / 7.5), MAP_ALPHA));
  EXPECT_NE(words_of_masks(made.legend, true, "tiled").find("tiled drops lights"), std::string::npos);
  EXPECT_NE(words_of_masks(made.legend, false, "tiled").find("keeps no mask"), std::string::npos);
}

/// Against a mask made here, in double precision: a depth may be a rounding away in the part beside.
TEST(MaskOverlay, MasksHoldTheDepths) {
  Request request = small_viewer().state.request;
  request.scene = "posts";
  const lamp::app::Setup setup = make_setup(request);
  Session session(request, setup);
  Renderer& renderer = session.renderer();
  Lighting lighting = session.lighting(parse_method("tiled"), {}, ShadingPath::deferred);
  static_cast<void>(renderer.relight(lighting));
  const std::vector<float> depth = renderer.read_depth();
  const NumberedCells cells = numbered_cells(renderer.visit_all(lighting));
  const std::vector<gpu::CellMask> masks = cell_masks(renderer, cells.of_pixels, cells.count);
  std::vector<std::uint32_t> seen(cells.count, 0);
  for (std::size_t i = 0; i < depth.size(); ++i) {
    if (cells.of_pixels[i] == gpu::NO_CELL) continue;
    const gpu::CellMask& mask = masks[cells.of_pixels[i]];
    const double z = setup.view.z_view(depth[i]);
    ASSERT_GE(z, mask.z_near * (1.0 - 1e-5));
    ASSERT_LE(z, mask.z_far * (1.0 + 1e-5));
    const double part = (z - mask.z_near) / std::max(double{mask.z_far} - mask.z_near, 1e-30) * 32.0;
    const auto bit = [](double at) { return 1U << static_cast<std::uint32_t>(std::clamp(at, 0.0, 31.0)); };
    EXPECT_NE(mask.mask & (bit(part - 0.01) | bit(part + 0.01)), 0U);
    seen[cells.of_pixels[i]] |= bit(part - 0.01) | bit(part + 0.01);
  }
  for (std::uint32_t i = 0; i < cells.count; ++i) {
    EXPECT_EQ(masks[i].mask & ~seen[i], 0U);
    EXPECT_EQ(masks[i].mask & 1U, 1U);  // the nearest surface is in the first part
  }
}

/// The light that is looked at: its parts and the mask say what the test for the mask says, listed or not.
TEST(MaskOverlay, TellsWhyALightIsDropped) {
  const ShaderLibrary shaders("");
  Stage stage(view_context(), shaders, "");
  ViewState state = small_viewer().state;
  state.request.scene = "posts";
  state.request.lights = 300;
  state.request.options = {"bounds=mask"};
  state.picked = glm::uvec2(48, 44);
  std::size_t dropped = 0;
  std::size_t listed = 0;
  for (std::uint32_t light = 0; light < 300; light += 7) {
    state.light = light;
    const Shown shown = stage.draw(state, {96, 54});
    EXPECT_TRUE(shown.first.keeps_masks);
    const Inspection& found = *shown.inspection;
    ASSERT_TRUE(found.looked_at);
    const LookedAt& looked = *found.looked_at;
    EXPECT_EQ(looked.light, light);
    EXPECT_EQ((looked.passes & gpu::PASSES_DEPTHS) != 0, looked.parts != 0);
    if (looked.parts != 0) {
      EXPECT_EQ((looked.passes & gpu::PASSES_MASK) != 0, (looked.parts & found.mask.mask) != 0);
    }
    listed += looked.listed ? 1 : 0;
    const std::string words = words_of_parts(found);
    if (!looked.listed && looked.passes != gpu::PASSES_ALL) {
      ++dropped;
      EXPECT_NE(words.find("not in this list: dropped by"), std::string::npos) << words;
    }
  }
  EXPECT_GT(dropped, 0);
  EXPECT_GT(listed, 0);
}

}  // namespace
}  // namespace lamp::app
