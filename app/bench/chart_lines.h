// The charts that results ask for: which result belongs to which line of which chart.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace lamp::app {

/// A result in a line; `x` is a number or a text, as the parameter that the chart is over.
struct ChartPoint {
  nlohmann::json x;
  std::size_t result = 0;  ///< place in "results"
};

struct ChartLine {
  std::string label;
  std::vector<ChartPoint> points;
};

/// One chart of a series: results that differ in x and line alone.
struct ChartPanel {
  std::string series;
  std::string where;  ///< what tells it from the series' other charts: "blocks, 1920x1080"; empty: there are none
  std::string x, y;
  bool log_x = false;
  bool log_y = false;
  bool flight = false;
  std::vector<ChartLine> lines;
};

/// The charts of all series, in the suite's order. Throws Error, naming `file`, for results without series or
/// parameters.
[[nodiscard]] std::vector<ChartPanel> chart_panels(const nlohmann::json& results, const std::string& file);

/// A result's value of the chart's y ("cull", "excess", …); of times the median. Nothing: it has none.
[[nodiscard]] std::optional<double> value_of(const nlohmann::json& result, const std::string& y);

/// "cull and shade", "lights a cell"; with its unit: "cull and shade, ms".
[[nodiscard]] std::string words_of(const std::string& y);

[[nodiscard]] nlohmann::json to_json(const ChartPanel& panel);

}  // namespace lamp::app
