// What repeated measurements say: percentiles, trends, crossovers, and how passes add up to the time of a cull.
// SPDX-License-Identifier: Apache-2.0
#include "bench/statistics.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "render/frame_times.h"

namespace lamp::app {
namespace {

TEST(BenchStatistics, SpreadOfKnownSamples) {
  std::vector<double> samples;
  for (int i = 100; i >= 0; --i) samples.push_back(i);
  const Spread spread = spread_of(samples);
  EXPECT_EQ(spread.median, 50.0);
  EXPECT_EQ(spread.p5, 5.0);
  EXPECT_EQ(spread.p95, 95.0);
  EXPECT_DOUBLE_EQ(spread.mean, 50.0);
  EXPECT_NEAR(spread.deviation, std::sqrt(850.0), 1e-9);
}

TEST(BenchStatistics, FewSamples) {
  EXPECT_EQ(spread_of({}).median, 0.0);
  const Spread one = spread_of({7.0});
  EXPECT_EQ(one.p5, 7.0);
  EXPECT_EQ(one.p95, 7.0);
  EXPECT_EQ(one.deviation, 0.0);
  const Spread two = spread_of({4.0, 2.0});
  EXPECT_EQ(two.median, 3.0);
  EXPECT_LT(two.median, two.p95);
  EXPECT_EQ(spread_of({5.0, 1.0, 2.0, 9.0}).median, 3.5);
}

// A GPU that sleeps at first and wakes in the course of the frames is slow in most, whatever it runs.
TEST(BenchStatistics, AClockMovedIfAllAreSlowerThanTheirBest) {
  const Spread moved = spread_of({0.031, 0.05, 0.099, 0.099, 0.1});
  const Spread steady = spread_of({0.031, 0.031, 0.032, 0.032, 0.1});
  EXPECT_TRUE(clock_moved(std::array{moved}));
  EXPECT_TRUE(clock_moved(std::array{moved, moved}));
  EXPECT_FALSE(clock_moved(std::array{moved, steady})) << "one method alone varies by itself";
  EXPECT_FALSE(clock_moved(std::array{steady}));
  EXPECT_FALSE(clock_moved({}));
}

TEST(BenchStatistics, MovingAverageIsOverNeighbours) {
  const std::vector<Point> averages = moving_average({{3, 30}, {1, 10}, {2, 50}, {4, 70}}, 3);
  ASSERT_EQ(averages.size(), 4U);
  EXPECT_EQ(averages[0].x, 1.0);
  EXPECT_DOUBLE_EQ(averages[0].y, 30.0) << "two points at the end";
  EXPECT_DOUBLE_EQ(averages[1].y, 30.0);
  EXPECT_DOUBLE_EQ(averages[2].y, 50.0);
  EXPECT_DOUBLE_EQ(averages[3].y, 50.0);
}

TEST(BenchStatistics, PointsOfOneXBecomeOne) {
  const std::vector<Point> points{{1, 4}, {2, 1}, {2, 3}, {5, 9}};
  const std::vector<Point> all = merged(points);
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[1].x, 2.0);
  EXPECT_EQ(all[1].y, 2.0);
  EXPECT_TRUE(merged({}).empty());
}

TEST(BenchStatistics, CrossoverIsWhereTheCandidateStaysBelow) {
  const std::vector<Point> other{{1, 10}, {2, 10}, {3, 10}, {4, 10}};
  EXPECT_EQ(crossover(std::vector<Point>{{1, 12}, {2, 9}, {3, 11}, {4, 8}}, other), 4.0);
  EXPECT_EQ(crossover(std::vector<Point>{{1, 12}, {2, 9}, {3, 9}, {4, 8}}, other), 2.0);
  EXPECT_EQ(crossover(std::vector<Point>{{1, 1}, {2, 1}, {3, 1}, {4, 10}}, other), 1.0);
  EXPECT_EQ(crossover(std::vector<Point>{{1, 1}, {2, 1}, {3, 1}, {4, 11}}, other), std::nullopt);
  EXPECT_EQ(crossover({}, {}), std::nullopt);
}

TEST(BenchStatistics, GeometricMean) {
  EXPECT_DOUBLE_EQ(geometric_mean(std::vector<double>{2.0, 8.0}), 4.0);
  EXPECT_EQ(geometric_mean({}), 0.0);
}

// Between two passes that count lies what the device waits for: it counts too. Before, after and around others it does
// not.
TEST(BenchStatistics, ASpanHoldsTheGapsBetweenItsPasses) {
  const std::vector<vulkan::Timestamps::Time> times{{"g-buffer", 0.0, 5.0},
                                                    {"clear", 6.0, 7.0},
                                                    {"tiled cull", 9.0, 12.0},
                                                    {"deferred shading", 15.0, 20.0},
                                                    {"cluster count", 30.0, 31.0}};
  const auto cull = [](std::string_view pass) {
    return pass == "clear" || pass == "tiled cull" || pass == "cluster count";
  };
  EXPECT_DOUBLE_EQ(span_ms(times, cull), (12.0 - 6.0) + (31.0 - 30.0));
  EXPECT_DOUBLE_EQ(span_ms(times, [](std::string_view) { return true; }), 31.0);
  EXPECT_EQ(span_ms(times, [](std::string_view) { return false; }), 0.0);
}

TEST(BenchStatistics, APassIsAllOfItsRunsInAFrame) {
  PassSums sums;
  for (const auto& [pass, ms] :
       {std::pair("clear", 1.0), {"cluster count", 2.0}, {"cluster count", 4.0}, {"clear", 8.0}})
    add_to(sums, pass, ms);
  EXPECT_EQ(sums, (PassSums{{"clear", 9.0}, {"cluster count", 6.0}}));
}

}  // namespace
}  // namespace lamp::app
