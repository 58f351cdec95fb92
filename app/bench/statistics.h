// What repeated measurements say: spread, trend, and where two trends cross.
// Based on: Stewart, Compute-Based Tiled Culling, GPU Pro 7 (2016), figures 1.12 and 1.13.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace lamp::app {

/// Of some samples; all 0 when there are none.
struct Spread {
  double median = 0.0;
  double p5 = 0.0;
  double p95 = 0.0;
  double mean = 0.0;
  double deviation = 0.0;  ///< standard deviation of the samples, dividing by their number
};
[[nodiscard]] Spread spread_of(const std::vector<double>& samples);

/// Whether the device changed its clock under a group of measurements: the median of every one lies more than a fifth
/// above its 5th percentile. Nothing that one method does slows all of them.
[[nodiscard]] bool clock_moved(std::span<const Spread> group);

struct Point {
  double x = 0.0;
  double y = 0.0;
};

/// Sorted by x; y is the mean over the `window` (odd, at least 1) points around each, fewer at the ends.
[[nodiscard]] std::vector<Point> moving_average(std::vector<Point> points, std::size_t window);

/// Points sorted by x, those of one x made one with the mean of their y.
[[nodiscard]] std::vector<Point> merged(std::span<const Point> points);

/// The least x from which on `candidate` never lies above `other`. Both are sorted and have the same x, place by place.
/// Nothing: it still does at the end, or there are no points.
[[nodiscard]] std::optional<double> crossover(std::span<const Point> candidate, std::span<const Point> other);

/// The n-th root of the product of n values > 0; 0 when there are none.
[[nodiscard]] double geometric_mean(std::span<const double> values);

}  // namespace lamp::app
