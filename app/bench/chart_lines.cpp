// Sorts results into charts.
// SPDX-License-Identifier: Apache-2.0
#include "bench/chart_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "error.h"
#include "files/read_json.h"

namespace lamp::app {
namespace {

using nlohmann::json;

// Parameters that split a series into charts, in the order in which they are named; methods, paths and options are
// lines of one.
constexpr std::array<const char*, 9> SPLITS{"scene", "camera", "projection", "size",  "range",
                                            "spots", "lights", "decals",     "probes"};

/// Results say how many decals and probes there are where there are some.
json parameter_of(const json& result, const std::string& name) {
  const json& parameters = result.at("parameters");
  return name == "decals" || name == "probes" ? json(parameters.value(name, 0U)) : parameters.value(name, json());
}

std::string plain_text(const json& value) {
  return value.is_string() ? value.get<std::string>() : json_text(value, -1);
}

/// A split's value in words.
std::string named(const std::string& split, const json& value) {
  if (split == "lights" || split == "decals" || split == "probes") return plain_text(value) + " " + split;
  if (split == "spots") return fmt::format("{:g} % spots", 100.0 * value.get<double>());
  if (split == "range") return "range " + plain_text(value);
  return plain_text(value);
}

/// The splits that differ within a series, but for its x.
std::vector<std::string> splits_of(std::span<const json* const> results, const std::string& x) {
  std::vector<std::string> splits;
  for (const char* split : SPLITS) {
    const auto differs = [&](const json* result) {
      return parameter_of(*result, split) != parameter_of(*results.front(), split);
    };
    if (x != split && std::ranges::any_of(results, differs)) splits.emplace_back(split);
  }
  return splits;
}

std::string where_of(const json& result, std::span<const std::string> splits) {
  std::string where;
  for (const std::string& split : splits)
    where += (where.empty() ? "" : ", ") + named(split, parameter_of(result, split));
  return where;
}

/// The label, and swept options that are not the x.
std::string line_of(const json& result, const std::string& x) {
  if (x == "method") return "";
  std::string line = result.at("label");
  for (const auto& [key, value] : result.at("parameters").items())
    if (key.starts_with("option:") && key != x) line += fmt::format(" {}={}", key.substr(7), plain_text(value));
  return line;
}

/// What stands at the x axis: of a chart over methods, the labels.
json x_of(const json& result, const std::string& x) {
  if (x != "method") return parameter_of(result, x);
  std::string label = result.at("label");
  for (const auto& [key, value] : result.at("parameters").items())
    if (key.starts_with("option:")) label += fmt::format(" {}={}", key.substr(7), plain_text(value));
  return label;
}

template <class Row>
Row& find_or_add(std::vector<Row>& rows, std::string Row::* name, const std::string& value, const Row& fresh) {
  const auto found = std::ranges::find(rows, value, name);
  if (found != rows.end()) return *found;
  rows.push_back(fresh);
  rows.back().*name = value;
  return rows.back();
}

void add_series(const json& series, const json& results, std::vector<ChartPanel>& panels) {
  const json& chart = series.at("chart");
  std::vector<const json*> own;
  for (const json& result : results)
    if (result.at("series") == series.at("name")) own.push_back(&result);
  if (own.empty()) return;
  const ChartPanel fresh{.series = series.at("name"),
                         .x = chart.at("x"),
                         .y = chart.at("y"),
                         .log_x = chart.at("log_x"),
                         .log_y = chart.at("log_y"),
                         .flight = series.at("flight")};
  const std::vector<std::string> splits = splits_of(own, fresh.x);
  std::vector<ChartPanel> made;
  for (const json* result : own) {
    ChartPanel& panel = find_or_add(made, &ChartPanel::where, where_of(*result, splits), fresh);
    ChartLine& line = find_or_add(panel.lines, &ChartLine::label, line_of(*result, fresh.x), ChartLine{});
    line.points.push_back({x_of(*result, fresh.x), static_cast<std::size_t>(result - &results.front())});
  }
  for (ChartPanel& panel : made)
    for (ChartLine& line : panel.lines)
      if (line.points.front().x.is_number())
        std::ranges::sort(line.points, {}, [](const ChartPoint& point) { return point.x.get<double>(); });
  std::ranges::move(made, std::back_inserter(panels));
}

constexpr std::array<std::pair<const char*, const char*>, 11> WORDS{{{"cull", "cull, ms"},
                                                                     {"shade", "shade, ms"},
                                                                     {"cull+shade", "cull and shade, ms"},
                                                                     {"frame", "whole frame, ms"},
                                                                     {"excess", "excess (1 is perfect)"},
                                                                     {"waste", "waste (1 is perfect)"},
                                                                     {"missed", "missed pairs of pixel and light"},
                                                                     {"evaluations", "lights walked, all pixels"},
                                                                     {"list_mean", "lights a cell, mean"},
                                                                     {"list_max", "lights a cell, longest list"},
                                                                     {"bytes", "memory, bytes"}}};

}  // namespace

std::vector<ChartPanel> chart_panels(const json& results, const std::string& file) {
  std::vector<ChartPanel> panels;
  try {
    for (const json& series : results.at("suite").at("series")) add_series(series, results.at("results"), panels);
  } catch (const json::exception& error) {
    throw Error(fmt::format("{}: is damaged: {}; expected a results.json as lamp bench writes it", file, error.what()));
  }
  return panels;
}

std::optional<double> value_of(const json& result, const std::string& y) {
  const json& times = result.contains("times") ? result.at("times") : json();
  if (times.is_object() && times.contains(y)) {
    const double median = times.at(y).at("median").get<double>();
    const bool has_none = y == "cull" && median == 0.0;  // brute force
    return has_none ? std::nullopt : std::optional(median);
  }
  const json& stats = result.at("stats");
  if (y == "bytes" && stats.contains("bytes")) return stats.at("bytes").at("total").get<double>();
  if (stats.contains(y) && stats.at(y).is_number()) return stats.at(y).get<double>();
  return std::nullopt;
}

std::string words_of(const std::string& y) {
  const auto found = std::ranges::find(WORDS, y, [](const auto& row) { return std::string(row.first); });
  return found == WORDS.end() ? y : found->second;
}

json to_json(const ChartPanel& panel) {
  json lines = json::array();
  for (const ChartLine& line : panel.lines) {
    json points = json::array();
    for (const ChartPoint& point : line.points) points.push_back({{"x", point.x}, {"result", point.result}});
    lines.push_back({{"label", line.label}, {"points", points}});
  }
  return {{"series", panel.series}, {"where", panel.where}, {"x", panel.x},           {"y", panel.y},
          {"log_x", panel.log_x},   {"log_y", panel.log_y}, {"flight", panel.flight}, {"lines", lines}};
}

}  // namespace lamp::app
