// Reads results.json: what a value must be, as data, so that whoever takes results up may trust them.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "bench/results.h"
#include "error.h"
#include "files/json_rules.h"
#include "files/json_values.h"
#include "files/read_file.h"
#include "files/read_json.h"

namespace lamp::app {
namespace {

using nlohmann::json;

constexpr std::size_t MOST_SAMPLES = std::size_t{1} << 24;  // rows of all flights
constexpr double LARGEST = 9007199254740992.0;              // 2^53: whole in a double

constexpr std::string_view SERIES = "suite/series/*";
constexpr std::string_view CHART = "suite/series/*/chart";
constexpr std::string_view RESULT = "results/*";
constexpr std::string_view PARAMETERS = "results/*/parameters";
constexpr std::string_view STATS = "results/*/stats";
constexpr std::string_view TIMES = "results/*/times";
constexpr std::string_view SAMPLE = "results/*/samples/*";

constexpr Rule text(std::string_view at, std::string_view key) {
  return {.at = at, .key = key, .want = Want::text, .required = true};
}
constexpr Rule flag(std::string_view at, std::string_view key) {
  return {.at = at, .key = key, .want = Want::flag, .required = true};
}
constexpr Rule count(std::string_view at, std::string_view key, bool required) {
  return {.at = at, .key = key, .want = Want::natural, .required = required, .min = 0, .max = LARGEST};
}
/// Milliseconds and ratios of them. null is what a number that is none was written as.
constexpr Rule amount(std::string_view at, std::string_view key, bool required) {
  return {.at = at, .key = key, .want = Want::number, .required = required, .nullable = !required, .min = 0};
}

constexpr auto RULES = std::to_array<Rule>({
    {.key = "run", .want = Want::object, .required = true},
    text("run", "command"),
    text("run", "device"),
    text("run", "device_kind"),
    text("run", "driver"),
    text("run", "commit"),
    text("run", "date"),
    {.at = "run", .key = "shaders", .want = Want::text},
    {.at = "run", .key = "pipeline_statistics", .want = Want::text},
    flag("run", "complete"),
    count("run", "left_out", /* required= */ false),
    {.at = "run", .key = "regret", .want = Want::object},
    count("run/regret", "count", /* required= */ true),
    amount("run/regret", "mean", /* required= */ true),
    amount("run/regret", "worst", /* required= */ true),
    text("run/regret", "where"),

    {.key = "suite", .want = Want::object, .required = true},
    text("suite", "name"),
    text("suite", "title"),
    text("suite", "about"),
    text("suite", "source"),
    {.at = "suite", .key = "series", .want = Want::objects, .required = true, .size = MOST_CONFIGURATIONS},
    text(SERIES, "name"),
    text(SERIES, "title"),
    text(SERIES, "about"),
    flag(SERIES, "flight"),
    {.at = SERIES, .key = "chart", .want = Want::object, .required = true},
    text(CHART, "x"),
    text(CHART, "y"),
    flag(CHART, "log_x"),
    flag(CHART, "log_y"),

    {.key = "results", .want = Want::objects, .required = true, .size = MOST_CONFIGURATIONS},
    text(RESULT, "key"),
    {.at = RESULT, .key = "hashes", .want = Want::named_texts},
    text(RESULT, "series"),
    text(RESULT, "label"),
    {.at = RESULT, .key = "parameters", .want = Want::object, .required = true},
    text(PARAMETERS, "scene"),
    text(PARAMETERS, "size"),
    count(PARAMETERS, "lights", /* required= */ true),
    {.at = PARAMETERS, .key = "spots", .want = Want::number, .required = true, .min = 0, .max = 1},
    count(PARAMETERS, "decals", /* required= */ false),
    count(PARAMETERS, "probes", /* required= */ false),
    text(PARAMETERS, "range"),
    text(PARAMETERS, "camera"),
    text(PARAMETERS, "projection"),
    text(PARAMETERS, "path"),
    text(PARAMETERS, "method"),
    {.at = RESULT,
     .key = "verdict",
     .want = Want::text,
     .required = true,
     .words = "exact, approximate, could not check, unverified, wrong, impossible"},
    text(RESULT, "reason"),
    {.at = RESULT, .key = "verified", .want = Want::text},
    {.at = RESULT, .key = "clock_moved", .want = Want::flag},
    {.at = RESULT, .key = "rounds", .want = Want::numbers, .min = 0},
    {.at = RESULT, .key = "pictures", .want = Want::named_texts},
    {.at = RESULT, .key = "regret", .want = Want::object},
    amount("results/*/regret", "factor", /* required= */ true),
    text("results/*/regret", "best"),
    amount("results/*/regret", "best_ms", /* required= */ true),
    {.at = RESULT, .key = "samples", .want = Want::objects, .size = MOST_SAMPLES},
    count(SAMPLE, "frame", /* required= */ true),
    count(SAMPLE, "lights", /* required= */ true),
    amount(SAMPLE, "cull", /* required= */ true),
    amount(SAMPLE, "shade", /* required= */ true),
    amount(SAMPLE, "frame_ms", /* required= */ true),

    {.at = RESULT, .key = "stats", .want = Want::object, .required = true},
    {.at = STATS, .key = "method", .want = Want::text},
    {.at = STATS, .key = "options", .want = Want::named_texts},
    {.at = STATS, .key = "notes", .want = Want::texts},
    {.at = STATS, .key = "bytes", .want = Want::object},
    count("results/*/stats/bytes", "total", /* required= */ true),
    count(STATS, "overflowed_cells", /* required= */ false),
    count(STATS, "missed", /* required= */ false),
    count(STATS, "useful", /* required= */ false),
    amount(STATS, "evaluations", /* required= */ false),
    amount(STATS, "list_mean", /* required= */ false),
    amount(STATS, "list_max", /* required= */ false),
    amount(STATS, "waste", /* required= */ false),
    amount(STATS, "excess", /* required= */ false),

    {.at = RESULT, .key = "times", .want = Want::object, .required = true, .nullable = true},
    {.at = TIMES, .key = "cull", .want = Want::object, .required = true},
    {.at = TIMES, .key = "shade", .want = Want::object, .required = true},
    {.at = TIMES, .key = "cull+shade", .want = Want::object, .required = true},
    {.at = TIMES, .key = "frame", .want = Want::object, .required = true},
});

constexpr auto SPREADS = std::to_array<std::string_view>(
    {"results/*/times/cull", "results/*/times/shade", "results/*/times/cull+shade", "results/*/times/frame"});

constexpr auto SPREAD_RULES = std::to_array<Rule>({
    amount("", "median", /* required= */ true),
    amount("", "p5", /* required= */ true),
    amount("", "p95", /* required= */ true),
    amount("", "mean", /* required= */ true),
    amount("", "deviation", /* required= */ true),
});

}  // namespace

json parse_results(std::string_view text, const std::string& file) {
  json document = parse_json(text, file);
  if (!document.is_object() || document.value("format", json()) != RESULTS_FORMAT)
    throw Error(fmt::format("{}: is no results file; expected a results.json of lamp bench", file));
  if (document.value("version", json()) != RESULTS_VERSION)
    throw Error(fmt::format("{}: version: expected {}, got {}; measure anew, or use the lamp that wrote it", file,
                            RESULTS_VERSION, shown(document.value("version", json()))));
  check_rules(document, RULES, file);
  for (const std::string_view spread : SPREADS) check_rules(document, SPREAD_RULES, file, spread);
  return document;
}

json load_results(const std::filesystem::path& file) {
  return within_memory(file.string(), [&] {
    return parse_results(text_of(read_file(file, {.expected = "a results.json of lamp bench"})), file.string());
  });
}

}  // namespace lamp::app
