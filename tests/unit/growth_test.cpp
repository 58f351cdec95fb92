// More room for lists: as much as was needed, as far as options and devices allow.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>

#include "lamplight/method.h"

namespace lamp {
namespace {

struct Planned {
  const Method& method;
  Problem problem;
  Plan plan;
};

Planned planned(std::string_view name, const std::vector<std::string>& settings, std::uint32_t lights = 4096) {
  const Method& method = *find_method(name).value();
  // So large that lists do not hold every light in every cell by default.
  Problem problem{
      .width = 1920, .height = 1080, .light_capacity = lights, .options = resolve_options(method, settings).value()};
  problem.traits.max_storage_buffer_bytes = ~0U;
  Plan plan = make_plan(method, problem).value();
  return {method, std::move(problem), std::move(plan)};
}

TEST(Growth, WhatFitsStaysAsItIs) {
  for (const Method& method : methods()) {
    SCOPED_TRACE(method.name);
    const Planned p = planned(method.name, {});
    EXPECT_EQ(p.plan.capacities.empty(), p.plan.counters == NO_RESOURCE);
    const std::vector<std::uint32_t> nothing(p.plan.capacities.size(), 0);
    EXPECT_FALSE(grow_plan(p.method, p.problem, p.plan, nothing));
    std::vector<std::uint32_t> all;
    for (const Capacity& capacity : p.plan.capacities)
      all.push_back(static_cast<std::uint32_t>(capacity.entries / capacity.entries_per_count));
    EXPECT_FALSE(grow_plan(p.method, p.problem, p.plan, all));
  }
}

TEST(Growth, EveryCapacityGrowsToTheNeedAndAQuarterMore) {
  for (const Method& method : methods()) {
    const Planned p = planned(method.name, {});
    for (std::size_t i = 0; i < p.plan.capacities.size(); ++i) {
      const Capacity& capacity = p.plan.capacities[i];
      SCOPED_TRACE(std::string(method.name) + " " + std::string(capacity.option));
      std::vector<std::uint32_t> needed(p.plan.capacities.size(), 0);
      needed[i] = static_cast<std::uint32_t>(capacity.entries / capacity.entries_per_count + 1);
      const auto grown = grow_plan(p.method, p.problem, p.plan, needed);
      ASSERT_TRUE(grown);
      EXPECT_GE(grown->plan.capacities[i].entries, needed[i] * capacity.entries_per_count * 5ULL / 4);
      EXPECT_GE(grown->plan.bytes(), p.plan.bytes()) << "a list in shared memory takes no buffer";
      EXPECT_GT(grown->options.integer(capacity.option), p.problem.options.integer(capacity.option));
      EXPECT_FALSE(grow_plan(p.method, p.problem, p.plan, std::vector<std::uint32_t>(needed.size(), 0)));
    }
  }
}

/// A quarter more than was needed, and by half more than there was.
TEST(Growth, GrowsByNoLessThanItSays) {
  const Planned p = planned("clustered", {"mean_capacity=64"});
  const std::uint64_t entries = p.plan.capacities[0].entries;
  for (const std::uint64_t needed : {entries + 1, 4 * entries + 1}) {
    const auto grown = grow_plan(p.method, p.problem, p.plan, std::vector{static_cast<std::uint32_t>(needed)});
    ASSERT_TRUE(grown);
    const std::uint64_t wanted = std::max(needed + needed / 4, entries + entries / 2);
    EXPECT_GE(grown->plan.capacities[0].entries, wanted);
    EXPECT_LT(grown->plan.capacities[0].entries, wanted + p.plan.capacities[0].per_option);
  }
}

/// A count that is wrong asks for more than every light in every cluster.
TEST(Growth, EndsWhereThereIsRoomForEverything) {
  const Planned p = planned("clustered", {"mean_capacity=100"}, 100);
  EXPECT_FALSE(grow_plan(p.method, p.problem, p.plan, std::vector<std::uint32_t>{~0U}));
}

TEST(Growth, EndsWhereTheOptionEnds) {
  const Planned p = planned("tiled", {"capacity=2000"});
  const auto grown = grow_plan(p.method, p.problem, p.plan, std::vector<std::uint32_t>{4000});
  ASSERT_TRUE(grown);
  EXPECT_EQ(grown->options.integer("capacity"), 2048);
  const Planned most = planned("tiled", {"capacity=2048"});
  EXPECT_FALSE(grow_plan(most.method, most.problem, most.plan, std::vector<std::uint32_t>{4000}));
}

/// A swarm between two pixels of a small picture: four tiles hold every light, and the others nothing.
TEST(Growth, SharedListsTakeEveryLightInAFewCells) {
  for (const std::string_view name : {"lamplight", "clustered"}) {
    SCOPED_TRACE(name);
    const Method& method = *find_method(name).value();
    Problem problem{
        .width = 32, .height = 32, .light_capacity = MAX_LIGHTS, .options = resolve_options(method, {}).value()};
    problem.traits.max_storage_buffer_bytes = ~0U;
    problem.traits.max_groups[0] = ~0U;
    const Result<Plan> made = make_plan(method, problem);
    ASSERT_TRUE(made.ok()) << made.error().text();
    const Plan& plan = made.value();
    std::vector<std::uint32_t> needed(plan.capacities.size(), 0);
    needed.back() = 4 * MAX_LIGHTS;
    ASSERT_LT(plan.capacities.back().entries, needed.back());
    const auto grown = grow_plan(method, problem, plan, needed);
    ASSERT_TRUE(grown);
    EXPECT_GE(grown->plan.capacities.back().entries, needed.back());
  }
}

TEST(Growth, EndsWhereTheDeviceEnds) {
  Planned p = planned("clustered", {"mean_capacity=64"});
  const std::uint64_t entries = p.plan.capacities[0].entries;
  p.problem.traits.max_storage_buffer_bytes = entries * 4 * 3;
  const auto grown = grow_plan(p.method, p.problem, p.plan, std::vector<std::uint32_t>{~0U});
  ASSERT_TRUE(grown);
  EXPECT_GT(grown->plan.capacities[0].entries, entries);
  EXPECT_LE(grown->plan.capacities[0].entries * 4, p.problem.traits.max_storage_buffer_bytes);
  p.problem.traits.max_storage_buffer_bytes = entries * 4;
  EXPECT_FALSE(grow_plan(p.method, p.problem, p.plan, std::vector<std::uint32_t>{~0U}));
}

TEST(Growth, ListsHaveNoMoreRoomThanEveryLightInEveryCluster) {
  EXPECT_EQ(planned("clustered", {"mean_capacity=16777216"}, 100).plan.capacities[0].entries,
            planned("clustered", {"mean_capacity=100"}, 100).plan.capacities[0].entries);
}

TEST(Growth, CapacitiesMustSayWhereNeedsAreCounted) {
  Planned p = planned("clustered", {});
  p.plan.capacities[0].needed_offset = 16;
  EXPECT_NE(plan_check(p.plan, {})->text().find("capacity mean_capacity: the count at byte 16"), std::string::npos);
  p.plan.capacities[0].needed_offset = 2;
  EXPECT_TRUE(plan_check(p.plan, {}));
  p.plan.capacities[0] = {.option = "mean_capacity", .needed_offset = 4};
  EXPECT_NE(plan_check(p.plan, {})->text().find("must say how it grows"), std::string::npos);
  p.plan.capacities[0] = {.option = "mean_capacity", .per_option = 1};
  p.plan.buffers[p.plan.counters - PLAN_BUFFER].memory = BufferMemory::device;
  EXPECT_EQ(plan_check(p.plan, {})->text(), "counters: must be in memory of counts, of each view");
  p.plan.counters = NO_RESOURCE;
  EXPECT_NE(plan_check(p.plan, {})->text().find("the plan has no counters"), std::string::npos);
}

}  // namespace
}  // namespace lamp
