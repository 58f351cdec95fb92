// Small devices: plans keep to their buffers, work groups and shared memory, and take no more than can be needed.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "lamplight/method.h"
#include "lamplight/shared/world.h"
#include "unit/devices.h"

namespace lamp {
namespace {

Result<Plan> planned(std::string_view name, UVec2 size, std::uint32_t lights, const std::vector<std::string>& settings,
                     const DeviceTraits& traits = test::LARGE_DEVICE) {
  const Method& method = *find_method(name).value();
  return make_plan(method, {.width = size.x,
                            .height = size.y,
                            .light_capacity = lights,
                            .options = resolve_options(method, settings).value(),
                            .traits = traits});
}

std::uint64_t entries_of(const Plan& plan, std::string_view option) {
  return std::ranges::find(plan.capacities, option, &Capacity::option)->entries;
}

TEST(SmallDevices, HoldThePiecesOfCells) {
  DeviceTraits traits = test::LARGE_DEVICE;
  traits.max_storage_buffer_bytes = 1U << 26;
  for (const char* depth : {"depth=buffer", "depth=none"})
    for (const char* container : {"container=list", "container=bits"})
      for (const char* tile : {"tile=8", "tile=32"}) {
        const auto plan = planned("lamplight", {3840, 2160}, 1U << 20,
                                  {depth, container, tile, "cells=list", "mean_cells=64"}, traits);
        EXPECT_TRUE(plan) << depth << ' ' << container << ' ' << tile << ": " << plan.error().text();
      }
}

/// That dispatch is indirect, so no other check sees it. Small subgroups have small groups.
TEST(SmallDevices, ScatterAllHitsInTheGroupsThatTheyTake) {
  for (const std::uint32_t subgroup : {4U, 8U, 16U, 32U, 64U}) {
    DeviceTraits traits = test::LARGE_DEVICE;
    traits.max_groups[0] = 65535;
    traits.subgroup_size = traits.max_subgroup_size = subgroup;
    const Plan plan = planned("lamplight", {1920, 1080}, 1U << 21, {"cells=list", "mean_cells=8"}, traits).value();
    const Pass& scatter = *std::ranges::find(plan.passes, "scatter hits", &Pass::name);
    const std::uint32_t threads = scatter.constants.front();
    const std::uint64_t groups = (std::uint64_t{scatter.constants.back()} + threads - 1) / threads;
    EXPECT_LE(groups, 65535U) << subgroup;
    EXPECT_GT(groups, 32000U) << subgroup;
  }
}

TEST(SmallDevices, ShareLightsOutToTheGroupsThatThereAre) {
  DeviceTraits traits = test::LARGE_DEVICE;
  traits.max_groups[0] = 65535;
  for (const char* brick : {"brick=0", "brick=50", "brick=1600"}) {
    const auto plan = planned("world-cells", {1920, 1080}, 1U << 24, {brick, "mean_bricks=1"}, traits);
    ASSERT_TRUE(plan) << plan.error().text();
    const Pass& count = *std::ranges::find(plan.value().passes, "count bricks", &Pass::name);
    EXPECT_LE(count.extent.lights_per_group, 1U << shared::FOUND_LIGHT_BITS) << brick;
  }
}

/// A group of more lights than what was found can tell apart keeps none of it.
TEST(SmallDevices, FindBricksOfAllLightsWithFewGroups) {
  DeviceTraits traits = test::LARGE_DEVICE;
  traits.max_groups[0] = 1024;
  const Plan plan = planned("world-cells", {64, 64}, 1U << 24, {"mean_bricks=1", "brick=400"}, traits).value();
  const Pass& count = *std::ranges::find(plan.passes, "count bricks", &Pass::name);
  EXPECT_GE(std::uint64_t{count.extent.lights_per_group} * 1024, 1U << 24);
  EXPECT_GT(count.extent.lights_per_group, 1U << shared::FOUND_LIGHT_BITS);
  EXPECT_EQ(count.constants.back(), 1U);
}

TEST(SmallDevices, WithoutGroupsOrThreadsAreRefused) {
  DeviceTraits traits = test::LARGE_DEVICE;
  traits.max_groups[0] = 0;
  EXPECT_FALSE(planned("world-cells", {64, 64}, 1000, {}, traits));
  traits.max_group_invocations = 0;
  EXPECT_FALSE(planned("world-cells", {64, 64}, 1000, {}, traits));
}

/// What groups find takes the room of the bits, until these are made.
TEST(SmallDevices, KeepWhatGroupsFindWithinTheBits) {
  for (const char* cells : {"cells=4", "cells=16"})
    for (const char* mean : {"mean_bricks=1", "mean_bricks=24"})
      for (const std::uint32_t lights : {1U, 1000U, 1U << 20}) {
        const Plan plan = planned("world-cells", {1920, 1080}, lights, {cells, mean}).value();
        const Pass& count = *std::ranges::find(plan.passes, "count bricks", &Pass::name);
        const std::uint64_t groups = count.extent.counts(1920, 1080, lights)[0];
        const std::uint64_t found = groups * count.constants.back();
        EXPECT_GE(found, groups) << mean;
        EXPECT_LE(found * sizeof(shared::WorldFound),
                  std::ranges::find(plan.buffers, "cell bits", &BufferDesc::name)->bytes)
            << mean;
      }
}

/// Where every light in every tile would take little.
TEST(SmallDevices, HoldAGroupsListsInSharedMemory) {
  const auto capacity = [](std::uint32_t lights, const std::vector<std::string>& settings, std::uint32_t bytes) {
    DeviceTraits traits = test::LARGE_DEVICE;
    traits.shared_memory_bytes = bytes;
    return entries_of(planned("tiled", {32, 32}, lights, settings, traits).value(), "capacity");
  };
  EXPECT_EQ(capacity(2048, {"bounds=half"}, 32768), 2048U);
  EXPECT_EQ(capacity(2048, {"bounds=half"}, 16384), 512U);
  EXPECT_EQ(capacity(2049, {}, 65536), 512U) << "more than its flags are for";
}

TEST(SmallDevices, RefuseTypedListsWhosePlacesHaveMoreThan32Bits) {
  const auto plan = planned("tiled", {16384, 16384}, 4096, {"order=type", "tile=8", "capacity=2048"});
  ASSERT_FALSE(plan);
  EXPECT_NE(plan.error().text().find("option capacity: cells x capacity must stay below 2^32"), std::string::npos)
      << plan.error().text();
}

TEST(SmallDevices, TakeNoMoreThanEveryLightInEveryTile) {
  const Plan plan = planned("tiled", {1920, 1080}, 200, {"order=type", "mean_capacity=2048"}).value();
  EXPECT_EQ(entries_of(plan, "mean_capacity"), plan.cells * 200);
}

/// As its descriptor has it, each slot begins where any device lets it.
TEST(SmallDevices, BindTheCountsOfEachFrame) {
  Plan plan;
  const BufferDesc counts{.name = "counts", .bytes = 20, .memory = BufferMemory::counts};
  EXPECT_EQ(plan.view_bytes(counts), 768U);
  EXPECT_EQ(plan.view_bytes({.name = "lists", .bytes = 20}), 20U);
  plan.views = 2;
  EXPECT_EQ(plan.view_bytes({.name = "lists", .bytes = 20}), 768U);
  EXPECT_EQ(plan.view_bytes({.name = "spheres", .bytes = 20, .all_views = true}), 20U);
}

}  // namespace
}  // namespace lamp
