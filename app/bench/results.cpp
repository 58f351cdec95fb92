// Makes, reads and joins results.
// SPDX-License-Identifier: Apache-2.0
#include "bench/results.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "error.h"
#include "files/json_values.h"
#include "files/read_json.h"

namespace lamp::app {
namespace {

using nlohmann::json;

json to_json(const Series& series) {
  return {
      {"name", series.name},
      {"title", series.title},
      {"about", series.about},
      {"flight", series.flight.has_value()},
      {"chart",
       {{"x", series.chart.x}, {"y", series.chart.y}, {"log_x", series.chart.log_x}, {"log_y", series.chart.log_y}}}};
}

bool has_result(const json& results, const Group& group, const GroupEntry& entry) {
  const std::string key = key_of(group, entry);
  const json hashes = hashes_of(group, entry);
  return std::ranges::any_of(results["results"], [&](const json& result) {
    return result["key"].get_ref<const std::string&>() == key && result.value("hashes", json::object()) == hashes &&
           !result.value("clock_moved", false);
  });
}

/// Names that a suite may have changed since.
void name_anew(json& result, const GroupEntry& entry) {
  result["label"] = entry.label;
  json& parameters = result["parameters"];
  for (const auto& [key, value] : entry.swept) parameters["option:" + key] = value;
}

std::set<std::string> keys_of(std::span<const Group> groups) {
  std::set<std::string> keys;
  for (const Group& group : groups)
    for (const GroupEntry& entry : group.entries) keys.insert(key_of(group, entry));
  return keys;
}

/// What two runs must have in common, so that their times may stand beside each other. `usual`: what runs had before
/// they said so.
struct SameField {
  const char* name;
  std::string_view usual;
};
constexpr std::array<SameField, 5> SAME{
    {{"device", ""}, {"driver", ""}, {"commit", ""}, {"shaders", BUILT_IN}, {"pipeline_statistics", OFF}}};

/// Throws Error unless both runs agree on a field.
void check_same(const json& results, const json& earlier, const std::string& file, const SameField& field) {
  const std::string now = results["run"].value(field.name, std::string(field.usual));
  const std::string then = earlier["run"].value(field.name, std::string(field.usual));
  if (now == then) return;
  throw Error(
      fmt::format("{}: was measured with {} {}, and now it is {}; expected the same, another --out, or --overwrite",
                  file, field.name, shown(json(then)), shown(json(now))));
}

/// A cell of the table: quoted where it must be.
std::string csv_cell(const json& value) {
  if (value.is_null()) return "";
  if (!value.is_string()) return json_text(value, -1);
  std::string text = value.get<std::string>();
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

constexpr std::array<const char*, 4> RESULT_COLUMNS{"series", "label", "verdict", "reason"};
constexpr std::array<const char*, 7> PARAMETER_COLUMNS{"scene", "size", "lights", "range", "spots", "method", "path"};
constexpr std::array<const char*, 3> STATS_COLUMNS{"frames", "overflowed_cells", "cells"};
constexpr std::array<const char*, 4> TIMES{"cull", "shade", "cull+shade", "frame"};
constexpr std::array<const char*, 5> SPREAD{"median", "p5", "p95", "mean", "deviation"};
constexpr std::array<const char*, 8> FOUND{"list_mean", "list_max", "missed", "evaluations",
                                           "useful",    "waste",    "excess", "image_max_abs_diff"};

constexpr std::array<const char*, 2> REGRET{"factor", "best"};

json value_or_null(const json& object, const char* key) { return object.contains(key) ? object[key] : json(); }

/// What has no column of its own: "decals=64 shadows=pcf".
std::string further_parameters(const json& parameters) {
  std::vector<std::string> words;
  for (const auto& [key, value] : parameters.items())
    if (std::ranges::find(PARAMETER_COLUMNS, key) == PARAMETER_COLUMNS.end() && !key.starts_with("option:"))
      words.push_back(fmt::format("{}={}", key, value.is_string() ? value.get<std::string>() : value.dump()));
  return fmt::format("{}", fmt::join(words, " "));
}

std::vector<std::string> csv_row(const json& entry) {
  std::vector<std::string> cells;
  for (const char* key : RESULT_COLUMNS) cells.push_back(csv_cell(value_or_null(entry, key)));
  for (const char* key : PARAMETER_COLUMNS) cells.push_back(csv_cell(value_or_null(entry["parameters"], key)));
  const json& stats = entry["stats"];
  for (const char* key : STATS_COLUMNS) cells.push_back(csv_cell(value_or_null(stats, key)));
  std::vector<std::string> options;
  if (stats.contains("options"))
    for (const auto& [key, value] : stats["options"].items()) options.push_back(key + "=" + value.get<std::string>());
  cells.push_back(csv_cell(fmt::format("{}", fmt::join(options, " "))));
  cells.push_back(csv_cell(further_parameters(entry["parameters"])));
  for (const char* time : TIMES)
    for (const char* part : SPREAD)
      cells.push_back(entry["times"].is_null() ? "" : csv_cell(entry["times"][time][part]));
  cells.push_back(stats.contains("bytes") ? csv_cell(stats["bytes"]["total"]) : "");
  for (const char* key : FOUND) cells.push_back(csv_cell(value_or_null(stats, key)));
  const json regret = value_or_null(entry, "regret");
  for (const char* key : REGRET) cells.push_back(csv_cell(regret.is_null() ? json() : regret[key]));
  cells.push_back(csv_cell(fmt::format("{}", fmt::join(stats.value("notes", std::vector<std::string>()), "; "))));
  return cells;
}

std::vector<std::string> csv_header() {
  std::vector<std::string> names(RESULT_COLUMNS.begin(), RESULT_COLUMNS.end());
  names.insert(names.end(), PARAMETER_COLUMNS.begin(), PARAMETER_COLUMNS.end());
  names.insert(names.end(), STATS_COLUMNS.begin(), STATS_COLUMNS.end());
  names.emplace_back("options");
  names.emplace_back("parameters");
  for (const char* time : TIMES)
    for (const char* part : SPREAD) names.push_back(fmt::format("{}_ms_{}", time, part));
  names.emplace_back("bytes");
  names.insert(names.end(), FOUND.begin(), FOUND.end());
  for (const char* key : REGRET) names.push_back(fmt::format("regret_{}", key));
  names.emplace_back("notes");
  return names;
}

}  // namespace

json to_json(const Spread& s) {
  return {{"median", s.median}, {"p5", s.p5}, {"p95", s.p95}, {"mean", s.mean}, {"deviation", s.deviation}};
}

json new_results(const RunInfo& run, const Suite& suite) {
  json series = json::array();
  for (const Series& one : suite.series) series.push_back(to_json(one));
  return {{"format", RESULTS_FORMAT},
          {"version", RESULTS_VERSION},
          {"run",
           {{"command", run.command},
            {"device", run.device},
            {"device_kind", run.device_kind},
            {"driver", run.driver},
            {"commit", run.commit},
            {"date", run.date},
            {"shaders", run.shaders},
            {"pipeline_statistics", run.pipeline_statistics},
            {"complete", false}}},
          {"suite",
           {{"name", suite.name},
            {"title", suite.title},
            {"about", suite.about},
            {"source", suite.source},
            {"series", series}}},
          {"results", json::array()}};
}

void check_earlier(const json& results, const json& earlier, const std::string& file, std::span<const Group> groups) {
  if (earlier["suite"]["name"] != results["suite"]["name"])
    throw Error(fmt::format("{}: holds the suite {}; expected {}, another --out, or --overwrite", file,
                            shown(earlier["suite"]["name"]), shown(results["suite"]["name"])));
  for (const SameField& field : SAME) check_same(results, earlier, file, field);
  const std::set<std::string> wanted = keys_of(groups);
  std::vector<std::string> lost;
  for (const json& result : earlier["results"])
    if (!wanted.contains(result["key"])) lost.push_back(result["key"]);
  if (lost.empty()) return;
  throw Error(
      fmt::format("{}: {} of its {} results would be lost, as this run does not measure them, such as '{}'; expected "
                  "another --out, or --overwrite",
                  file, lost.size(), earlier["results"].size(), lost.front()));
}

std::size_t take_over(json& results, const json& earlier, std::span<const Group> groups) {
  std::map<std::string, const GroupEntry*> wanted;
  std::set<std::string> complete;
  for (const Group& group : groups) {
    bool is_complete = true;
    for (const GroupEntry& entry : group.entries) {
      const bool is_there = has_result(earlier, group, entry);
      is_complete = is_complete && is_there;
      if (is_there) wanted.emplace(key_of(group, entry), &entry);
    }
    if (is_complete) complete.merge(keys_of({&group, 1}));
  }
  std::size_t again = 0;
  for (const json& result : earlier["results"]) {
    const std::string key = result["key"];
    if (!complete.contains(key)) ++again;
    const auto found = wanted.find(key);
    if (found == wanted.end()) continue;
    results["results"].push_back(result);
    name_anew(results["results"].back(), *found->second);
  }
  return again;
}

json hashes_of(const Group& group, const GroupEntry& entry) {
  json hashes = json::object();
  if (!group.scene_hash.empty()) hashes["scene"] = group.scene_hash;
  if (!entry.calibration_hash.empty()) hashes["calibration"] = entry.calibration_hash;
  return hashes;
}

bool has_group(const json& results, const Group& group) {
  return std::ranges::all_of(group.entries, [&](const GroupEntry& entry) { return has_result(results, group, entry); });
}

void add_group(json& results, const std::vector<json>& entries) {
  std::set<std::string> keys;
  for (const json& entry : entries) keys.insert(entry["key"]);
  json kept = json::array();
  for (json& entry : results["results"])
    if (!keys.contains(entry["key"])) kept.push_back(std::move(entry));
  for (const json& entry : entries) kept.push_back(entry);
  results["results"] = std::move(kept);
}

std::string results_csv(const json& results) {
  std::string text = fmt::format("{}\n", fmt::join(csv_header(), ","));
  for (const json& entry : results["results"]) text += fmt::format("{}\n", fmt::join(csv_row(entry), ","));
  return text;
}

}  // namespace lamp::app
