// Which probes have slots and are captured: budgets, priorities, eviction, and that nothing starves.
// SPDX-License-Identifier: Apache-2.0
#include "render/probe_schedule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace lamp::app {
namespace {

std::vector<std::uint32_t> drawn(const ProbeFrame& frame) {
  std::vector<std::uint32_t> probes;
  for (const ProbeDraw& draw : frame.draws) probes.push_back(draw.probe);
  return probes;
}

TEST(ProbeSchedule, StillSurroundingsAreCapturedOnce) {
  ProbeSchedule schedule(3, 3);
  const std::vector<ProbeDemand> probes{{.share = 0.1F}, {.share = 0.5F}, {.share = 0.0F}};
  EXPECT_EQ(schedule.slot(1), ProbeSchedule::NO_SLOT);
  EXPECT_EQ(drawn(schedule.schedule({.probes = probes})), (std::vector<std::uint32_t>{1, 0}));
  const ProbeFrame second = schedule.schedule({.probes = probes});
  EXPECT_TRUE(second.draws.empty());
  EXPECT_EQ(second.counts.seen, 2U);
  EXPECT_EQ(second.counts.captured, 2U);
  EXPECT_NE(schedule.slot(0), schedule.slot(1));
  EXPECT_EQ(schedule.slot(2), ProbeSchedule::NO_SLOT);
}

TEST(ProbeSchedule, NeverCapturedComesBeforeChanged) {
  ProbeSchedule schedule(2, 2);
  std::vector<ProbeDemand> probes{{.share = 1.0F}, {.share = 0.0F}};
  static_cast<void>(schedule.schedule({.probes = probes}));
  probes = {{.share = 1.0F, .changed = true}, {.share = 0.01F}};
  const ProbeFrame frame = schedule.schedule({.probes = probes, .budget = 1});
  EXPECT_EQ(drawn(frame), std::vector<std::uint32_t>{1});
  EXPECT_EQ(frame.waiting, std::vector<std::uint32_t>{0});
}

TEST(ProbeSchedule, WhatChangedUnseenIsCapturedWhenItIsSeen) {
  ProbeSchedule schedule(1, 1);
  static_cast<void>(schedule.schedule({.probes = std::vector<ProbeDemand>{{.share = 1.0F}}}));
  EXPECT_TRUE(schedule.schedule({.probes = std::vector<ProbeDemand>{{.changed = true}}}).draws.empty());
  EXPECT_EQ(schedule.schedule({.probes = std::vector<ProbeDemand>{{.share = 1.0F}}}).draws.size(), 1U);
}

TEST(ProbeSchedule, TheLeastRecentlySeenLosesItsSlot) {
  ProbeSchedule schedule(3, 2);
  const auto see = [&](std::vector<float> shares) {
    std::vector<ProbeDemand> probes;
    for (const float share : shares) probes.push_back({.share = share});
    return schedule.schedule({.probes = probes});
  };
  static_cast<void>(see({1.0F, 0.0F, 0.0F}));
  static_cast<void>(see({0.0F, 0.1F, 0.0F}));
  EXPECT_EQ(see({0.0F, 0.0F, 0.1F}).counts.evicted, 1U);
  EXPECT_EQ(schedule.slot(0), ProbeSchedule::NO_SLOT);
  EXPECT_NE(schedule.slot(1), ProbeSchedule::NO_SLOT);
}

TEST(ProbeSchedule, ProbesSeenAlikeDoNotTakeTurns) {
  ProbeSchedule schedule(3, 2);
  const std::vector<ProbeDemand> probes(3, {.share = 0.3F});
  static_cast<void>(schedule.schedule({.probes = probes}));
  for (int i = 0; i < 5; ++i) {
    const ProbeFrame frame = schedule.schedule({.probes = probes});
    EXPECT_EQ(frame.counts.evicted, 0U);
    EXPECT_EQ(frame.without, std::vector<std::uint32_t>{2});
    EXPECT_EQ(frame.counts.without_slot, 1U);
  }
  const std::vector<ProbeDemand> nearer{{.share = 0.3F}, {.share = 0.3F}, {.share = 0.7F}};
  EXPECT_EQ(schedule.schedule({.probes = nearer}).counts.evicted, 1U);
  EXPECT_NE(schedule.slot(2), ProbeSchedule::NO_SLOT);
}

TEST(ProbeSchedule, WithoutSlotsOrBudgetNothingIsDrawn) {
  const std::vector<ProbeDemand> probes(2, {.share = 1.0F});
  ProbeSchedule no_slots(2, 0);
  EXPECT_EQ(no_slots.schedule({.probes = probes}).counts.without_slot, 2U);
  ProbeSchedule no_budget(2, 2);
  const ProbeFrame frame = no_budget.schedule({.probes = probes, .budget = 0});
  EXPECT_TRUE(frame.draws.empty());
  EXPECT_EQ(frame.counts.waiting, 2U);
  EXPECT_EQ(frame.counts.longest_wait, 1U);
  EXPECT_TRUE(ProbeSchedule(0, 4).schedule({}).draws.empty());
}

/// Random demands: slots are one probe's, budgets hold, and everything is counted.
TEST(ProbeSchedule, HoldsItsPromisesForRandomDemands) {
  std::mt19937 random(3);
  const auto below = [&](std::uint32_t n) { return std::uniform_int_distribution<std::uint32_t>(0, n - 1)(random); };
  for (int round = 0; round < 60; ++round) {
    const std::uint32_t count = 1 + below(40);
    const std::uint32_t slots = below(50);
    ProbeSchedule schedule(count, slots);
    for (int i = 0; i < 80; ++i) {
      std::vector<ProbeDemand> probes(count);
      for (ProbeDemand& probe : probes)
        probe = {.share = below(2) == 0 ? 0.0F : static_cast<float>(below(1000)) / 999.0F, .changed = below(4) == 0};
      const std::uint32_t budget = below(6);
      const ProbeFrame frame = schedule.schedule({.probes = probes, .budget = budget});
      ASSERT_LE(frame.draws.size(), budget);
      ASSERT_TRUE(frame.waiting.empty() || frame.draws.size() == budget) << "what waits does so for the budget alone";
      std::set<std::uint32_t> used;
      for (std::uint32_t probe = 0; probe < count; ++probe)
        if (schedule.slot(probe) != ProbeSchedule::NO_SLOT) {
          ASSERT_LT(schedule.slot(probe), slots);
          ASSERT_TRUE(used.insert(schedule.slot(probe)).second);
        }
      for (const ProbeDraw& draw : frame.draws) ASSERT_EQ(schedule.slot(draw.probe), draw.slot);
      const auto seen = std::ranges::count_if(probes, [](const ProbeDemand& p) { return p.share > 0.0F; });
      ASSERT_EQ(frame.counts.seen, seen);
      ASSERT_LE(frame.counts.captured + frame.counts.without_slot, frame.counts.seen);
    }
  }
}

/// All change in every frame, whatever part of the picture they light: the stated bound holds for each.
TEST(ProbeSchedule, NothingStarves) {
  std::mt19937 random(5);
  for (const std::uint32_t budget : {1U, 2U, 5U})
    for (const std::uint32_t count : {3U, 16U, 40U}) {
      ProbeSchedule schedule(count, count);
      std::vector<ProbeDemand> probes(count);
      for (ProbeDemand& probe : probes) probe = {.share = random() % 2 == 0 ? 1.0F : 0.001F, .changed = true};
      std::uint32_t longest = 0;
      for (int i = 0; i < 2000; ++i)
        longest = std::max(longest, schedule.schedule({.probes = probes, .budget = budget}).counts.longest_wait);
      const double bound = ProbeSchedule::MOST_WEIGHT * (static_cast<double>(count) / budget + 1.0);
      EXPECT_LE(longest, bound) << count << " probes, budget " << budget;
      std::vector<int> captures(count);
      for (int i = 0; i < static_cast<int>(bound) + 1; ++i)
        for (const ProbeDraw& draw : schedule.schedule({.probes = probes, .budget = budget}).draws)
          ++captures[draw.probe];
      EXPECT_TRUE(std::ranges::all_of(captures, [](int n) { return n > 0; }));
    }
}

/// New probes come again and again: those that wait for another capture get theirs all the same.
TEST(ProbeSchedule, NewcomersAreCapturedOnceAndThenWaitLikeOthers) {
  constexpr std::uint32_t COUNT = 30;
  ProbeSchedule schedule(COUNT, COUNT);
  std::vector<ProbeDemand> probes(COUNT);
  probes[0] = {.share = 0.001F, .changed = true};
  int captures = 0;
  for (std::uint32_t i = 0; i < 600; ++i) {
    if (i % 20 == 19) probes[1 + i / 20 % (COUNT - 1)] = {.share = 1.0F, .changed = true};
    const ProbeFrame frame = schedule.schedule({.probes = probes, .budget = 1});
    captures += frame.draws.front().probe == 0 ? 1 : 0;
  }
  EXPECT_GT(captures, 5);
}

}  // namespace
}  // namespace lamp::app
