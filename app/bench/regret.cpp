// Compares `auto` with the best.
// SPDX-License-Identifier: Apache-2.0
#include "bench/regret.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "bench/statistics.h"
#include "bench/summary.h"
#include "files/read_json.h"

namespace lamp::app {
namespace {

using nlohmann::json;

/// What rivals have in common, as text.
std::string frames_of(const json& result) {
  json parameters = result["parameters"];
  parameters.erase("method");
  std::vector<std::string> options;
  for (const auto& [key, value] : parameters.items())
    if (key.starts_with("option:")) options.push_back(key);
  for (const std::string& key : options) parameters.erase(key);
  return json_text(result["series"], -1) + json_text(parameters, -1);
}

bool is_auto_result(const json& result) { return result["parameters"]["method"] == "auto"; }

bool is_rival(const json& result) { return !result["times"].is_null() && result["verdict"] != "approximate"; }

double ms_of(const json& result) { return result["times"]["cull+shade"]["median"]; }

std::string where_of(const json& result) {
  const json& p = result["parameters"];
  return fmt::format("{} {} {} lights", p["scene"].get<std::string>(), p["size"].get<std::string>(),
                     p["lights"].dump());
}

double ratio(double ms, double other_ms) { return other_ms > 0.0 ? ms / other_ms : 1.0; }

/// Where both have as many rounds, the median of what each round says: a device that changes its clock between rounds
/// changes it for both.
double factor_over(const json& chosen, const json& other) {
  const auto rounds = chosen.value("rounds", std::vector<double>());
  const auto others = other.value("rounds", std::vector<double>());
  if (rounds.empty() || rounds.size() != others.size()) return ratio(ms_of(chosen), ms_of(other));
  std::vector<double> ratios;
  std::ranges::transform(rounds, others, std::back_inserter(ratios), ratio);
  return spread_of(ratios).median;
}

json regret_of(const json& results, const json& chosen) {
  const json* best = &chosen;
  double factor = 1.0;
  const std::string frames = frames_of(chosen);
  for (const json& other : results["results"]) {
    if (!is_rival(other) || frames_of(other) != frames) continue;
    const double over = factor_over(chosen, other);
    if (over <= factor) continue;
    factor = over;
    best = &other;
  }
  return {{"factor", factor}, {"best", (*best)["label"]}, {"best_ms", ms_of(*best)}};
}

}  // namespace

void add_regret(json& results) {
  double log_sum = 0.0;
  std::size_t count = 0;
  double worst = 0.0;
  std::string where;
  for (json& result : results["results"]) {
    if (!is_auto_result(result) || !is_rival(result)) continue;
    result["regret"] = regret_of(results, result);
    const double factor = result["regret"]["factor"];
    log_sum += std::log(factor);
    ++count;
    if (factor <= worst) continue;
    worst = factor;
    where = fmt::format("{}: {} instead of {}", where_of(result), result["stats"].value("method", ""),
                        result["regret"]["best"].get<std::string>());
  }
  if (count == 0) return;
  results["run"]["regret"] = {
      {"count", count}, {"mean", std::exp(log_sum / static_cast<double>(count))}, {"worst", worst}, {"where", where}};
}

std::string regret_words(const json& results) {
  if (!results["run"].contains("regret")) return "";
  const json& regret = results["run"]["regret"];
  return fmt::format(
      "auto took {} times the best method's time of cull and shading on average (geometric mean of {} configurations), "
      "at worst {} times: {}.",
      short_number(regret["mean"]), regret["count"].get<std::size_t>(), short_number(regret["worst"]),
      regret["where"].get<std::string>());
}

}  // namespace lamp::app
