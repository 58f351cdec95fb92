// Spread, moving average, crossover.
// SPDX-License-Identifier: Apache-2.0
#include "bench/statistics.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>

#include "render/frame_times.h"

namespace lamp::app {

Spread spread_of(const std::vector<double>& samples) {
  if (samples.empty()) return {};
  Spread spread{.median = percentile(samples, 0.5), .p5 = percentile(samples, 0.05), .p95 = percentile(samples, 0.95)};
  const auto count = static_cast<double>(samples.size());
  for (const double sample : samples) spread.mean += sample / count;
  double variance = 0.0;
  for (const double sample : samples) variance += (sample - spread.mean) * (sample - spread.mean) / count;
  spread.deviation = std::sqrt(variance);
  return spread;
}

bool clock_moved(std::span<const Spread> group) {
  constexpr double FAR = 1.2;
  return !group.empty() && std::ranges::all_of(group, [](const Spread& s) { return s.median > FAR * s.p5; });
}

std::vector<Point> moving_average(std::vector<Point> points, std::size_t window) {
  assert(window % 2 == 1 && "take an odd number of points, so that the average stands above its middle");
  std::ranges::sort(points, [](const Point& a, const Point& b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); });
  std::vector<Point> averages;
  averages.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t first = i - std::min(i, window / 2);
    const std::size_t end = std::min(points.size(), i + window / 2 + 1);
    double sum = 0.0;
    for (std::size_t j = first; j < end; ++j) sum += points[j].y;
    averages.push_back({points[i].x, sum / static_cast<double>(end - first)});
  }
  return averages;
}

std::vector<Point> merged(std::span<const Point> points) {
  std::vector<Point> all;
  for (std::size_t i = 0; i < points.size();) {
    const std::size_t first = i;
    double sum = 0.0;
    for (; i < points.size() && points[i].x == points[first].x; ++i) sum += points[i].y;
    all.push_back({points[first].x, sum / static_cast<double>(i - first)});
  }
  return all;
}

std::optional<double> crossover(std::span<const Point> candidate, std::span<const Point> other) {
  assert(candidate.size() == other.size() && "compare trends over the same points");
  std::optional<double> from;
  for (std::size_t i = candidate.size(); i-- > 0;) {
    if (candidate[i].y > other[i].y) break;
    from = candidate[i].x;
  }
  return from;
}

double geometric_mean(std::span<const double> values) {
  if (values.empty()) return 0.0;
  double sum = 0.0;
  for (const double value : values) sum += std::log(value) / static_cast<double>(values.size());
  return std::exp(sum);
}

}  // namespace lamp::app
