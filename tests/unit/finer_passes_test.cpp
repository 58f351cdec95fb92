// Passes for smaller pictures in the plan of a larger one: those that a plan for that size has, over the same buffers.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "lamplight/method.h"

namespace {

using lamp::CellGrid;
using lamp::Plan;

struct Size {
  std::uint32_t width, height;
};
constexpr Size LARGE{3840, 2160};
constexpr Size SMALL{1920, 1080};
constexpr std::uint32_t MANY_LIGHTS = 1024;
constexpr std::uint32_t FEW_LIGHTS = 64;  // which are culled in one pass

Plan lamplight(const Size& size, std::uint32_t lights, bool smaller_frames) {
  const lamp::Method& method = *lamp::find_method("lamplight").value();
  return lamp::make_plan(method, {.width = size.width,
                                  .height = size.height,
                                  .light_capacity = lights,
                                  .options = lamp::resolve_options(method, {}).value(),
                                  .traits = {.max_group_invocations = 1024, .shared_memory_bytes = 49152},
                                  .smaller_frames = smaller_frames})
      .value();
}

TEST(FinerPasses, AreThoseOfAPlanForThatSize) {
  for (const std::uint32_t lights : {MANY_LIGHTS, FEW_LIGHTS}) {
    const Plan plan = lamplight(LARGE, lights, true);
    const Plan own = lamplight(SMALL, lights, false);
    EXPECT_EQ(plan.cell_shift(LARGE.width, LARGE.height), 0U);
    const std::uint32_t shift = plan.cell_shift(SMALL.width, SMALL.height);
    if (lights == FEW_LIGHTS) {
      EXPECT_EQ(shift, 0U);  // 8160 tiles are more than a group each would be good for
      EXPECT_EQ(plan.cell_shift(640, 360), 2U);
      continue;
    }
    ASSERT_EQ(plan.finer.size(), 1U);
    ASSERT_EQ(shift, plan.finer.front().shift);
    for (std::size_t i = 0; i < 2; ++i) {  // tile depth and find cells know no capacity
      EXPECT_EQ(plan.finer.front().passes[i].constants, own.passes[i].constants) << own.passes[i].name;
      EXPECT_EQ(plan.finer.front().passes[i].extent.cells.px, own.passes[i].extent.cells.px) << own.passes[i].name;
    }
    EXPECT_EQ(plan.finer.front().cells.px, own.passes.front().extent.cells.px);
  }
}

TEST(FinerPasses, AreForAsManyCellsAsTheySay) {
  const Plan plan{.finer = {{.shift = 2, .cells = {.px = 8}, .most_cells = 16},
                            {.shift = 1, .cells = {.px = 16}, .most_cells = 16}}};
  EXPECT_EQ(plan.cell_shift(32, 32), 2U);
  EXPECT_EQ(plan.cell_shift(33, 32), 1U);
  EXPECT_EQ(plan.cell_shift(64, 64), 1U);
  EXPECT_EQ(plan.cell_shift(65, 64), 0U);
}

TEST(FinerPasses, AreThereIfFramesAreSmaller) {
  EXPECT_TRUE(lamplight(LARGE, MANY_LIGHTS, false).finer.empty());
  EXPECT_TRUE(lamplight(SMALL, MANY_LIGHTS, true).finer.empty());  // its own cells have the fewest tiles
}

/// There is room for the cells of any picture that they are for.
TEST(FinerPasses, HaveRoomInTheBuffers) {
  const Plan plan = lamplight(LARGE, MANY_LIGHTS, true);
  const auto cells = std::ranges::find(plan.buffers, "cells", &lamp::BufferDesc::name);
  ASSERT_NE(cells, plan.buffers.end());
  for (std::uint32_t width = 1; width <= LARGE.width; width += 61)
    for (std::uint32_t height = 1; height <= LARGE.height; height += 61)
      for (const lamp::FinerPasses& finer : plan.finer) {
        if (finer.shift != plan.cell_shift(width, height)) continue;
        EXPECT_LE(finer.cells.count(width, height) * cells->cell_bytes, cells->bytes) << width << "x" << height;
      }
}

}  // namespace
