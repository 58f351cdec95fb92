// Matches results by key, divides.
// SPDX-License-Identifier: Apache-2.0
#include "bench/comparison.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "bench/statistics.h"

namespace lamp::app {
namespace {

using nlohmann::json;

/// How often and how closely something was measured may differ between devices.
std::string comparable_key(const json& result) {
  const std::string key = result.at("key");
  return key.substr(0, key.rfind(" | "));
}

std::map<std::string, std::size_t> timed_keys(const json& run) {
  std::map<std::string, std::size_t> keys;
  const json& results = run.at("results");
  for (std::size_t i = 0; i < results.size(); ++i)
    if (results[i].at("times").is_object()) keys.emplace(comparable_key(results[i]), i);
  return keys;
}

/// Of the files that the scene was read from, as far as both runs say.
bool are_of_one_scene(const json& a, const json& b) {
  const auto hash = [](const json& result) { return result.value("hashes", json::object()).value("scene", ""); };
  return hash(a).empty() || hash(b).empty() || hash(a) == hash(b);
}

double ratio(const json& a, const json& b, const char* time) {
  const double first = a.at("times").at(time).at("median");
  const double second = b.at("times").at(time).at("median");
  return first > 0.0 ? second / first : 0.0;
}

double mean_ratio(std::span<const ComparedRow> rows, const ComparedLine& line, double ComparedRow::* member) {
  std::vector<double> ratios;
  for (const ComparedRow& row : rows)
    if (row.series == line.series && row.label == line.label && row.*member > 0.0) ratios.push_back(row.*member);
  return geometric_mean(ratios);
}

std::vector<ComparedLine> lines_of(std::span<const ComparedRow> rows) {
  std::vector<ComparedLine> lines;
  for (const ComparedRow& row : rows) {
    auto found = std::ranges::find_if(
        lines, [&](const ComparedLine& line) { return line.series == row.series && line.label == row.label; });
    if (found == lines.end()) found = lines.insert(lines.end(), {.series = row.series, .label = row.label});
    ++found->count;
  }
  for (ComparedLine& line : lines) {
    line.cull_ratio = mean_ratio(rows, line, &ComparedRow::cull_ratio);
    line.cull_shade_ratio = mean_ratio(rows, line, &ComparedRow::cull_shade_ratio);
    line.frame_ratio = mean_ratio(rows, line, &ComparedRow::frame_ratio);
  }
  return lines;
}

}  // namespace

Comparison compare_runs(const json& a, const json& b) {
  const std::map<std::string, std::size_t> keys_a = timed_keys(a);
  const std::map<std::string, std::size_t> keys_b = timed_keys(b);
  Comparison comparison;
  for (const auto& [key, i] : keys_a) {
    const auto found = keys_b.find(key);
    if (found == keys_b.end()) {
      ++comparison.only_a;
      continue;
    }
    const json& first = a.at("results").at(i);
    const json& second = b.at("results").at(found->second);
    if (!are_of_one_scene(first, second)) {
      ++comparison.other_scene;
      continue;
    }
    comparison.rows.push_back({.key = key,
                               .series = first.at("series"),
                               .label = first.at("label"),
                               .a = i,
                               .b = found->second,
                               .cull_ratio = ratio(first, second, "cull"),
                               .cull_shade_ratio = ratio(first, second, "cull+shade"),
                               .frame_ratio = ratio(first, second, "frame")});
  }
  comparison.only_b = keys_b.size() - comparison.rows.size() - comparison.other_scene;
  std::ranges::sort(comparison.rows, {}, &ComparedRow::a);
  comparison.lines = lines_of(comparison.rows);
  return comparison;
}

json to_json(const Comparison& c) {
  json rows = json::array();
  for (const ComparedRow& r : c.rows)
    rows.push_back({{"key", r.key},
                    {"series", r.series},
                    {"label", r.label},
                    {"a", r.a},
                    {"b", r.b},
                    {"cull", r.cull_ratio},
                    {"cull+shade", r.cull_shade_ratio},
                    {"frame", r.frame_ratio}});
  json lines = json::array();
  for (const ComparedLine& l : c.lines)
    lines.push_back({{"series", l.series},
                     {"label", l.label},
                     {"count", l.count},
                     {"cull", l.cull_ratio},
                     {"cull+shade", l.cull_shade_ratio},
                     {"frame", l.frame_ratio}});
  return {{"rows", rows}, {"lines", lines}, {"only_a", c.only_a}, {"only_b", c.only_b}, {"other_scene", c.other_scene}};
}

}  // namespace lamp::app
