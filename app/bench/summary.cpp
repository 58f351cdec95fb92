// Ranks, finds leads and crossovers, says it.
// SPDX-License-Identifier: Apache-2.0
#include "bench/summary.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "bench/regret.h"

namespace lamp::app {
namespace {

using nlohmann::json;

/// A line's value at one x; of a time, the median and where nine samples in ten lie.
struct Ranked {
  std::string name;
  double value = 0.0;
  double low = 0.0;
  double high = 0.0;
};

/// Whether what tells them apart may be noise.
bool is_level(const Ranked& one, const Ranked& least) { return one.low <= least.high; }

bool less(const Ranked& a, const Ranked& b) { return std::tie(a.value, a.name) < std::tie(b.value, b.name); }

bool is_time(const std::string& y) { return y == "cull" || y == "shade" || y == "cull+shade" || y == "frame"; }

/// Nothing where the result has no such value.
std::optional<Ranked> ranked_of(const std::string& name, const json& result, const std::string& y) {
  const std::optional<double> value = value_of(result, y);
  if (!value) return std::nullopt;
  if (!is_time(y)) return Ranked{name, *value, *value, *value};
  const json& spread = result.at("times").at(y);
  return Ranked{name, *value, spread.at("p5"), spread.at("p95")};
}

std::string with_unit(double value, const std::string& y) { return short_number(value) + (is_time(y) ? " ms" : ""); }

/// "cull and shade", without unit.
std::string quantity(const std::string& y) {
  const std::string words = words_of(y);
  return words.substr(0, words.find(is_time(y) ? "," : " ("));
}

/// All that have a value at this x, the smallest first.
std::vector<Ranked> ranking(const json& results, const ChartPanel& panel, const json& x) {
  std::vector<Ranked> ranked;
  for (const ChartLine& line : panel.lines)
    for (const ChartPoint& point : line.points) {
      if (point.x != x) continue;
      if (const auto one = ranked_of(line.label, results.at("results").at(point.result), panel.y))
        ranked.push_back(*one);
    }
  std::ranges::sort(ranked, less);
  return ranked;
}

/// As ranking(), of a chart over methods: every bar has its own x.
std::vector<Ranked> ranking_of_bars(const json& results, const ChartPanel& panel) {
  std::vector<Ranked> ranked;
  for (const ChartLine& line : panel.lines)
    for (const ChartPoint& point : line.points)
      if (const auto one = ranked_of(point.x.get<std::string>(), results.at("results").at(point.result), panel.y))
        ranked.push_back(*one);
  std::ranges::sort(ranked, less);
  return ranked;
}

/// "tight (1.5×)": how much more than the least; of a least of 0 the value itself.
std::string behind_words(const Ranked& one, const Ranked& least, const std::string& y) {
  if (least.value > 0.0) return fmt::format("{} ({}×)", one.name, short_number(one.value / least.value));
  return fmt::format("{} ({})", one.name, with_unit(one.value, y));
}

/// "lamplight is ahead with 1.2 ms; next is tight (1.5×), last all (400×)." Those that are level with the first are
/// named together, and one alone is ahead of nobody.
std::string ranking_words(std::span<const Ranked> ranked, const std::string& y) {
  const Ranked& least = ranked.front();
  if (ranked.size() == 1) return fmt::format("{} has {}.", least.name, with_unit(least.value, y));
  const auto level =
      std::ranges::find_if_not(ranked, [&](const Ranked& one) { return is_level(one, least); }) - ranked.begin();
  std::string words = level == 1 ? least.name + " is ahead" : least.name;
  for (std::ptrdiff_t i = 1; i < level; ++i) words += (i + 1 < level ? ", " : " and ") + ranked[i].name;
  words += fmt::format("{} with {}", level == 1 ? "" : " are level", with_unit(least.value, y));
  const std::span<const Ranked> behind = ranked.subspan(level);
  if (!behind.empty()) words += "; next is " + behind_words(behind.front(), least, y);
  if (behind.size() > 1) words += ", last " + behind_words(behind.back(), least, y);
  return words + ".";
}

/// All x of a panel, ascending where they are numbers, else as they come.
std::vector<json> all_x(const ChartPanel& panel) {
  std::vector<json> all;
  for (const ChartLine& line : panel.lines)
    for (const ChartPoint& point : line.points)
      if (std::ranges::find(all, point.x) == all.end()) all.push_back(point.x);
  if (!all.empty() && all.front().is_number()) std::ranges::sort(all);
  return all;
}

std::string x_words(const ChartPanel& panel, const json& x) {
  for (const char* count : {"lights", "decals", "probes"})
    if (panel.x == count) return fmt::format("{} {}", x.get<std::uint64_t>(), count);
  const std::string name = panel.x.starts_with("option:") ? panel.x.substr(7) : panel.x;
  return fmt::format("{} {}", name, x.is_string() ? x.get<std::string>() : x.dump());
}

/// "tiled leads up to 1024 lights, then lamplight.", or nothing when one leads everywhere.
std::string lead_words(const json& results, const ChartPanel& panel, std::span<const json> xs) {
  std::string words;
  std::string leader;
  const json* last = nullptr;
  for (const json& x : xs) {
    const std::vector<Ranked> ranked = ranking(results, panel, x);
    if (ranked.empty()) continue;
    const auto stays = [&](const Ranked& one) { return one.name == leader && is_level(one, ranked.front()); };
    if (std::ranges::none_of(ranked, stays)) {
      if (!leader.empty()) words += fmt::format("{} up to {}, ", leader, x_words(panel, *last));
      leader = ranked.front().name;
    }
    last = &x;
  }
  return words.empty() ? "" : fmt::format("The lead changes: {}then {}.", words, leader);
}

std::vector<std::string> sweep_summary(const json& results, const ChartPanel& panel) {
  const std::vector<json> xs = all_x(panel);
  std::vector<std::string> sentences;
  for (auto x = xs.rbegin(); x != xs.rend(); ++x) {
    const std::vector<Ranked> ranked = ranking(results, panel, *x);
    if (ranked.empty()) continue;
    sentences.push_back(
        fmt::format("{}, with {}: {}", quantity(panel.y), x_words(panel, *x), ranking_words(ranked, panel.y)));
    if (xs.front().is_number()) break;
  }
  if (!xs.empty() && xs.front().is_number())
    if (const std::string words = lead_words(results, panel, xs); !words.empty()) sentences.push_back(words);
  return sentences;
}

/// How the first line of a flight does against another.
std::string duel_words(const Trend& first, const Trend& other) {
  const std::string words = fmt::format("{} takes {} % of the time of {} on average; ", first.label,
                                        short_number(100.0 * first.mean / other.mean), other.label);
  const auto from = crossover(first.average, other.average);
  if (!from) return words + "there is no number of lights from which on its moving average stays below.";
  if (*from <= first.average.front().x) return words + "its moving average is below for every number of lights.";
  return words + fmt::format("its moving average stays below from {:.0f} lights on.", *from);
}

std::vector<std::string> flight_summary(const json& results, const ChartPanel& panel) {
  const std::vector<Trend> lines = trends(results, panel);
  std::vector<std::string> sentences;
  for (std::size_t i = 1; i < lines.size(); ++i)
    if (lines[0].mean > 0.0 && lines[i].mean > 0.0 && lines[i].average.size() == lines[0].average.size())
      sentences.push_back(duel_words(lines[0], lines[i]));
  for (const Trend& line : lines)
    sentences.push_back(fmt::format("{}: {} on average, standard deviation {}.", line.label,
                                    with_unit(line.mean, panel.y), with_unit(line.deviation, panel.y)));
  return sentences;
}

/// The verdict, and apart from it what was found exact by its lists alone.
std::string kind_of(const json& result) {
  const std::string verdict = result.at("verdict");
  const bool lists_alone = result.value("verified", "").find("lists alone") != std::string::npos;
  return verdict == "exact" && lists_alone ? "lists" : verdict;
}

/// "12 missed no light and gave brute force's picture; 1 may miss lights, as published".
std::string verdict_words(const json& results) {
  constexpr std::array<std::pair<const char*, const char*>, 7> KINDS{
      {{"exact", "missed no light and gave brute force's picture"},
       {"lists", "missed no light (too many for brute force, so their pictures were not compared)"},
       {"approximate", "may miss lights, as published"},
       {"unverified", "were not verified"},
       {"could not check", "could not be checked on this device, and have their times"},
       {"wrong", "were wrong and got no time"},
       {"impossible", "could not run here"}}};
  std::string words;
  for (const auto& [kind, meaning] : KINDS) {
    const auto count = std::ranges::count(results.at("results"), kind, kind_of);
    if (count != 0) words += fmt::format("{}{} {}", words.empty() ? "" : "; ", count, meaning);
  }
  return words;
}

/// Warnings that follow from the device.
void add_device_notes(const json& run, std::vector<std::string>& sentences) {
  const std::string device = run.at("device");
  if (run.at("device_kind") == "CPU")
    sentences.emplace_back(
        "This is a software device on a CPU: its times count work done, and say little about any GPU. Compare methods "
        "on the GPU in question.");
  for (const char* name : {"H100", "H200", "A100"})
    if (device.find(name) != std::string::npos)
      sentences.push_back(fmt::format(
          "The {} has few graphics pipes for its size: rasterized and fragment-shaded passes (forward shading, light "
          "volumes) look slower here, next to compute, than on a GPU made for games.",
          name));
}

void add_losses(const json& results, std::vector<std::string>& sentences) {
  std::map<std::string, double> worst;
  std::uint64_t overflowed = 0;
  for (const json& result : results.at("results")) {
    const json& stats = result.at("stats");
    if (stats.value("overflowed_cells", 0U) != 0 ||
        stats.value(json::json_pointer("/transparent/overflowed_cells"), 0U) != 0)
      ++overflowed;
    if (result.at("verdict") != "approximate" || stats.value("missed", std::uint64_t{0}) == 0 ||
        stats.at("useful") == 0)
      continue;
    double& share = worst[result.at("label")];
    share = std::max(share, stats.at("missed").get<double>() / stats.at("useful").get<double>());
  }
  for (const auto& [label, share] : worst)
    sentences.push_back(fmt::format("{} missed up to {} % of the pairs of pixel and light that it should have found.",
                                    label, short_number(100.0 * share)));
  if (overflowed != 0)
    sentences.push_back(fmt::format(
        "In {} configurations a list overflowed its capacity: the pictures stay exact, because such cells walk every "
        "light, but their times suffer.",
        overflowed));
}

}  // namespace

std::string short_number(double value) {
  if (value == 0.0) return "0";
  const double magnitude = std::floor(std::log10(std::abs(value)));
  const int decimals = static_cast<int>(std::clamp(2.0 - magnitude, 0.0, 12.0));
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) text.pop_back();
  }
  return text;
}

std::size_t trend_window(std::size_t frames) { return frames / 20 * 2 + 1; }

std::vector<Trend> trends(const json& results, const ChartPanel& panel) {
  std::vector<Trend> lines;
  for (const ChartLine& line : panel.lines) {
    const json& result = results.at("results").at(line.points.front().result);
    if (!result.contains("samples") || result.at("samples").empty()) continue;
    std::vector<Point> points;
    std::vector<double> values;
    for (const json& sample : result.at("samples")) {
      const double value = panel.y == "cull+shade" ? sample.at("cull").get<double>() + sample.at("shade").get<double>()
                                                   : sample.at(panel.y == "frame" ? "frame_ms" : panel.y).get<double>();
      points.push_back({sample.at("lights").get<double>(), value});
      values.push_back(value);
    }
    const Spread spread = spread_of(values);
    // Frames with as many lights make one point, or the line would go up and down on the spot.
    lines.push_back({line.label, merged(moving_average(std::move(points), trend_window(values.size()))), spread.mean,
                     spread.deviation});
  }
  return lines;
}

std::vector<std::string> run_summary(const json& results) {
  const json& run = results.at("run");
  std::vector<std::string> sentences;
  sentences.push_back(fmt::format("{} configurations on {}, driver {}: {}.", results.at("results").size(),
                                  run.at("device").get<std::string>(), run.at("driver").get<std::string>(),
                                  verdict_words(results)));
  if (!run.at("complete").get<bool>())
    sentences.emplace_back("The run was stopped before its end: the charts show what it had until then.");
  if (const auto left_out = run.value("left_out", std::uint64_t{0}); left_out != 0)
    sentences.push_back(
        fmt::format("{} configurations of the suite lie beyond the limits of the command line.", left_out));
  add_losses(results, sentences);
  if (std::string words = regret_words(results); !words.empty()) sentences.push_back(std::move(words));
  add_device_notes(run, sentences);
  return sentences;
}

std::vector<std::string> panel_summary(const json& results, const ChartPanel& panel) {
  if (panel.flight) return flight_summary(results, panel);
  if (panel.x != "method") return sweep_summary(results, panel);
  const std::vector<Ranked> ranked = ranking_of_bars(results, panel);
  if (ranked.empty()) return {};
  return {fmt::format("{}: {}", quantity(panel.y), ranking_words(ranked, panel.y))};
}

}  // namespace lamp::app
