// What results say, in words: every number comes from the data.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "bench/chart_lines.h"
#include "bench/statistics.h"

namespace lamp::app {

/// Sentences about the whole run: how much was measured and verified, on what, and what to beware of.
[[nodiscard]] std::vector<std::string> run_summary(const nlohmann::json& results);

/// Sentences about one chart: who is ahead and by how much, where the lead changes; of a flight the means, standard
/// deviations and the number of lights from which on one is ahead.
[[nodiscard]] std::vector<std::string> panel_summary(const nlohmann::json& results, const ChartPanel& panel);

/// A flight's line: its samples' moving average over the number of lights.
struct Trend {
  std::string label;
  std::vector<Point> average;
  double mean = 0.0;
  double deviation = 0.0;
};
[[nodiscard]] std::vector<Trend> trends(const nlohmann::json& results, const ChartPanel& panel);

/// Frames of a flight that one point of the moving average covers.
[[nodiscard]] std::size_t trend_window(std::size_t frames);

/// Three significant digits: "12.3", "0.00456", "1230".
[[nodiscard]] std::string short_number(double value);

}  // namespace lamp::app
