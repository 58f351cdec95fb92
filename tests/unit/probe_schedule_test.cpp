// Which probes are captured: budgets, priorities, and that nothing starves.
// SPDX-License-Identifier: Apache-2.0
#include "render/probe_schedule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace lamp::app {
namespace {

using Probes = std::vector<std::uint32_t>;

TEST(ProbeSchedule, StillSurroundingsAreCapturedOnce) {
  ProbeSchedule schedule(3);
  const std::vector<ProbeDemand> probes{{.share = 0.1F}, {.share = 0.5F}, {.share = 1e-6F}};
  EXPECT_EQ(schedule.schedule({.probes = probes}).draws, (Probes{1, 0, 2}));
  const ProbeFrame second = schedule.schedule({.probes = probes});
  EXPECT_TRUE(second.draws.empty());
  EXPECT_EQ(second.counts.captured, 3U);
}

TEST(ProbeSchedule, NeverCapturedComesBeforeChanged) {
  ProbeSchedule schedule(2);
  std::vector<ProbeDemand> probes{{.share = 1.0F}, {.share = 0.01F}};
  EXPECT_EQ(schedule.schedule({.probes = probes, .budget = 1}).draws, Probes{0});
  probes[0].changed = true;
  const ProbeFrame frame = schedule.schedule({.probes = probes, .budget = 1});
  EXPECT_EQ(frame.draws, Probes{1});
  EXPECT_EQ(frame.counts.waiting, 1U);
}

TEST(ProbeSchedule, WhatChangedIsCapturedWhenThereIsABudget) {
  ProbeSchedule schedule(1);
  const std::vector<ProbeDemand> still{{.share = 1.0F}};
  static_cast<void>(schedule.schedule({.probes = still}));
  const std::vector<ProbeDemand> changed{{.share = 1.0F, .changed = true}};
  EXPECT_TRUE(schedule.schedule({.probes = changed, .budget = 0}).draws.empty());
  EXPECT_EQ(schedule.schedule({.probes = still}).draws, Probes{0});
}

TEST(ProbeSchedule, WithoutBudgetOrProbesNothingIsDrawn) {
  const std::vector<ProbeDemand> probes(2, {.share = 1.0F});
  ProbeSchedule schedule(2);
  const ProbeFrame frame = schedule.schedule({.probes = probes, .budget = 0});
  EXPECT_TRUE(frame.draws.empty());
  EXPECT_EQ(frame.counts.captured, 0U);
  EXPECT_EQ(frame.counts.waiting, 2U);
  EXPECT_EQ(frame.counts.longest_wait, 1U);
  EXPECT_TRUE(ProbeSchedule(0).schedule({}).draws.empty());
}

/// Random demands: budgets hold, and what has no capture or changed is drawn or counted.
TEST(ProbeSchedule, HoldsItsPromisesForRandomDemands) {
  std::mt19937 random(3);
  const auto below = [&](std::uint32_t n) { return std::uniform_int_distribution<std::uint32_t>(0, n - 1)(random); };
  for (int round = 0; round < 60; ++round) {
    const std::uint32_t count = 1 + below(40);
    ProbeSchedule schedule(count);
    std::set<std::uint32_t> captured;
    std::set<std::uint32_t> wanted;
    for (std::uint32_t probe = 0; probe < count; ++probe) wanted.insert(probe);
    for (int i = 0; i < 80; ++i) {
      std::vector<ProbeDemand> probes(count);
      for (std::uint32_t probe = 0; probe < count; ++probe) {
        probes[probe] = {.share = static_cast<float>(below(1000)) / 999.0F, .changed = below(4) == 0};
        if (probes[probe].changed) wanted.insert(probe);
      }
      const std::uint32_t budget = below(6);
      const ProbeFrame frame = schedule.schedule({.probes = probes, .budget = budget});
      ASSERT_EQ(frame.draws.size(), std::min<std::size_t>(budget, wanted.size()));
      for (const std::uint32_t probe : frame.draws) {
        ASSERT_EQ(wanted.erase(probe), 1U);
        captured.insert(probe);
      }
      ASSERT_EQ(frame.counts.drawn, frame.draws.size());
      ASSERT_EQ(frame.counts.waiting, wanted.size());
      ASSERT_EQ(frame.counts.captured, captured.size());
    }
  }
}

/// All change in every frame, whatever part of the picture they light: the stated bound holds for each.
TEST(ProbeSchedule, NothingStarves) {
  std::mt19937 random(5);
  for (const std::uint32_t budget : {1U, 2U, 5U})
    for (const std::uint32_t count : {3U, 16U, 40U}) {
      ProbeSchedule schedule(count);
      std::vector<ProbeDemand> probes(count);
      for (ProbeDemand& probe : probes) probe = {.share = random() % 2 == 0 ? 1.0F : 0.001F, .changed = true};
      std::uint32_t longest = 0;
      for (int i = 0; i < 2000; ++i)
        longest = std::max(longest, schedule.schedule({.probes = probes, .budget = budget}).counts.longest_wait);
      const double bound = ProbeSchedule::MOST_WEIGHT * (static_cast<double>(count) / budget + 1.0);
      EXPECT_LE(longest, bound) << count << " probes, budget " << budget;
      std::vector<int> captures(count);
      for (int i = 0; i < static_cast<int>(bound) + 1; ++i)
        for (const std::uint32_t probe : schedule.schedule({.probes = probes, .budget = budget}).draws)
          ++captures[probe];
      EXPECT_TRUE(std::ranges::all_of(captures, [](int n) { return n > 0; }));
    }
}

}  // namespace
}  // namespace lamp::app
