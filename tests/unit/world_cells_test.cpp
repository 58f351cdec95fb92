// When world cells have bits of cells and when of slices, and which of their options are refused.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "lamplight/method.h"
#include "unit/devices.h"

namespace lamp {
namespace {

Result<Plan> plan_of(const std::vector<std::string>& settings, std::uint32_t lights) {
  const Method& method = *find_method("world-cells").value();
  return make_plan(method, {.width = 64,
                            .height = 64,
                            .light_capacity = lights,
                            .options = resolve_options(method, settings).value(),
                            .traits = test::LARGE_DEVICE});
}

/// Along a brick, as the look-up is told.
std::uint32_t cells_of(const std::vector<std::string>& settings, std::uint32_t lights) {
  return plan_of(settings, lights).value().lookup.constants.at(1);
}

TEST(WorldCellsPlan, HasSlicesWhereLightsAreVeryMany) {
  EXPECT_EQ(cells_of({}, 240'000), 4U);
  EXPECT_EQ(cells_of({}, 250'000), 16U);
  EXPECT_EQ(cells_of({"brick=100"}, 1'000'000), 4U);
  EXPECT_EQ(cells_of({"cells=4"}, 1'000'000), 4U);
  EXPECT_EQ(cells_of({"cells=16"}, 100), 16U);
}

TEST(WorldCellsPlan, KeepsItsListsWithin64MiB) {
  for (const std::uint32_t lights : {100'000U, 243'000U, 244'000U, 300'000U, 1'000'000U, 1'500'000U}) {
    const Plan plan = plan_of({}, lights).value();
    std::uint64_t bytes = 0;
    for (const BufferDesc& buffer : plan.buffers)
      if (buffer.name == "bucket entries" || buffer.name == "cell bits") bytes += buffer.bytes;
    EXPECT_LE(bytes, 64U << 20) << lights;
    EXPECT_GT(bytes, 20U << 20) << lights;
  }
}

TEST(WorldCellsPlan, RefusesWhatBricksCannotBe) {
  EXPECT_EQ(resolve_options(*find_method("world-cells").value(), {"cells=8"}).error().text(),
            "option cells: '8' is not one of 0, 4, 16");
  EXPECT_EQ(plan_of({"brick=49"}, 1000).error().text(),
            "option brick: expected 0, or 50 and more: a light has at most 6 bricks across; got 49");
}

}  // namespace
}  // namespace lamp
