// Parses suites: strict, because a key that is misspelt and ignored measures something else than was meant.
// SPDX-License-Identifier: Apache-2.0
#include "bench/suite.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "bench/embedded_files.h"
#include "bench/groups.h"
#include "bench/suite_json.h"
#include "error.h"
#include "files/read_file.h"
#include "files/read_json.h"
#include "files/utf8_path.h"
#include "lamplight/method.h"
#include "render/mirror_pass.h"
#include "scene/decal.h"

namespace lamp::app {
namespace {

using nlohmann::json;

constexpr std::uint32_t MAX_FRAMES = 100000;
constexpr std::uint64_t LARGEST_SUITE = 1U << 24;  // bytes
constexpr std::array<std::string_view, 11> VALUES{"cull",   "shade",       "cull+shade", "frame",    "excess", "waste",
                                                  "missed", "evaluations", "list_mean",  "list_max", "bytes"};
constexpr std::span<const std::string_view> TIMES = std::span(VALUES).first(4);
constexpr std::string_view OPTION = "option:";
constexpr std::array<std::string_view, 11> AXES{"lights", "size",   "spots",      "range", "scene", "camera",
                                                "method", "decals", "projection", "path",  "probes"};

std::string joined(std::span<const std::string_view> words) { return fmt::format("{}", fmt::join(words, ", ")); }

bool is_swept(const Series& series, const std::string& option) {
  return std::ranges::find(series.options, option, [](const auto& swept) { return swept.first; }) !=
         series.options.end();
}

/// The chart of a series whose options and flight are known.
Chart parse_chart(const json& value, const Series& series, const std::string& where) {
  SuiteJson object(value, where + ": chart");
  Chart chart;
  object.read("x", chart.x);
  object.read("y", chart.y);
  object.read("log_x", chart.log_x);
  object.read("log_y", chart.log_y);
  object.finish();
  const bool is_option = chart.x.starts_with(OPTION) && is_swept(series, chart.x.substr(OPTION.size()));
  if (std::ranges::find(AXES, chart.x) == AXES.end() && !is_option)
    object.wrong("x", joined(AXES) + " or option:KEY of a KEY in the series' options");
  if (std::ranges::find(VALUES, chart.y) == VALUES.end()) object.wrong("y", joined(VALUES));
  if (series.flight && chart.x != "lights")
    object.wrong("x", "lights where there is a flight, as its frames differ in those");
  if (series.flight && std::ranges::find(TIMES, chart.y) == TIMES.end())
    object.wrong("y", joined(TIMES) + ", as each frame of a flight has them alone");
  return chart;
}

/// `auto` has no options: it chooses them.
void check_method(const SuiteMethod& method, const std::string& where) {
  if (method.name == "auto") {
    if (method.options.empty()) return;
    throw Error(fmt::format("{}: method auto: chooses its own options; expected none, got {}", where,
                            fmt::join(method.options, " ")));
  }
  const auto known = find_method(method.name);
  if (!known.ok()) throw Error(where + ": " + known.error().text());
  const auto options = resolve_options(*known.value(), method.options);
  if (!options.ok()) throw Error(fmt::format("{}: method {}: {}", where, method.name, options.error().text()));
}

Host parse_host(SuiteJson& object) {
  std::string name(host_names().front());
  object.read("host", name);
  const auto found = std::ranges::find(host_names(), name);
  if (found == host_names().end()) object.wrong("host", fmt::format("{}", fmt::join(host_names(), " or ")));
  return static_cast<Host>(found - host_names().begin());
}

SuiteMethod parse_method_entry(const json& value, const std::string& where) {
  SuiteMethod method;
  if (value.is_string()) {
    method.name = value.get<std::string>();
  } else {
    SuiteJson object(value, where + ": methods");
    object.require("name", method.name);
    if (object.has("options") && object.at("options") != json::array()) object.read("options", method.options);
    object.read("label", method.label);
    object.read("path", method.path);
    if (!method.path.empty() && std::ranges::find(path_names(), method.path) == path_names().end())
      object.wrong("path", joined(path_names()));
    object.read("still_lists", method.still_lists);
    object.read("still_occlusion", method.still_occlusion, 0, 1024);
    object.read("still_bytes", method.still_bytes, 0.0, 1e9);
    const bool known = method.still_lists == "triangle-lists" || method.still_lists == "world-tree";
    if (method.still_lists != "off" && (!known || method.path == "standard-deferred"))
      object.wrong("still_lists", "off, triangle-lists or world-tree; none with standard-deferred");
    method.host = parse_host(object);
    object.finish();
  }
  check_method(method, where);
  if (method.label.empty()) {
    method.label = method.name;
    for (const std::string& option : method.options) method.label += " " + option;
    if (!method.path.empty()) method.label += ", " + method.path;
    if (method.host != Host::plan)
      method.label += fmt::format(", {}", host_names()[static_cast<std::size_t>(method.host)]);
    if (method.still_lists != "off") method.label += ", " + method.still_lists;
    if (method.still_occlusion != 0) method.label += fmt::format(" {}", method.still_occlusion);
    if (method.still_bytes != SuiteMethod{}.still_bytes) method.label += fmt::format(", {} bytes", method.still_bytes);
  }
  return method;
}

/// Of entries with one label charts would make one line.
void check_labels(std::span<const SuiteMethod> entries, const std::string& where) {
  std::set<std::string_view> labels;
  for (const SuiteMethod& entry : entries)
    if (!labels.insert(entry.label).second)
      throw Error(
          fmt::format("{}: methods: two have the label '{}', expected one of its own for each", where, entry.label));
}

/// Lights of a suite move in every frame: what is made ahead has no part in it, but where it is named.
std::vector<SuiteMethod> every_method() {
  std::vector<SuiteMethod> all;
  for (const Method& method : methods())
    if (!method.still) all.push_back({.name = std::string(method.name), .label = std::string(method.name)});
  return all;
}

std::vector<SuiteMethod> parse_methods(SuiteJson& object) {
  if (!object.has("methods") || object.at("methods") == "all") return every_method();
  const json& list = object.at("methods");
  if (!list.is_array() || list.empty()) object.wrong("methods", "\"all\" or a list of methods");
  std::vector<SuiteMethod> entries;
  for (const json& value : list) entries.push_back(parse_method_entry(value, object.where()));
  check_labels(entries, object.where());
  return entries;
}

std::vector<std::pair<std::string, std::vector<std::string>>> parse_options(SuiteJson& object) {
  std::vector<std::pair<std::string, std::vector<std::string>>> options;
  if (!object.has("options")) return options;
  if (!object.at("options").is_object()) object.wrong("options", "an object such as {\"tile\": [\"8\", \"16\"]}");
  SuiteJson values(object.at("options"), object.where() + ": options");
  for (const auto& [key, ignored] : object.at("options").items())
    values.read(key, options.emplace_back(key, std::vector<std::string>{}).second);
  return options;
}

Verify parse_verify(SuiteJson& object) {
  if (!object.has("verify")) return {};
  const json& value = object.at("verify");
  if (value.is_boolean()) return {.what = value.get<bool>() ? Verify::What::picture : Verify::What::nothing};
  Verify verify{.what = Verify::What::rows};
  if (!value.is_object()) object.wrong("verify", "true, false or {\"rows\": N}");
  SuiteJson rows(value, object.where() + ": verify");
  rows.read("rows", verify.rows, 1, MAX_IMAGE_SIZE);
  rows.finish();
  if (verify.rows == 0) object.wrong("verify", "true, false or {\"rows\": N}");
  return verify;
}

std::optional<LightWave> parse_flight(SuiteJson& object) {
  if (!object.has("flight")) return std::nullopt;
  SuiteJson flight(object.at("flight"), object.where() + ": flight");
  LightWave wave;
  flight.read("from", wave.from, 0, MAX_LIGHTS);
  flight.read("to", wave.to, 0, MAX_LIGHTS);
  flight.read("waves", wave.waves, 1, 1000);
  flight.finish();
  if (!flight.has("to")) flight.missing("to", "the most lights of the flight");
  if (wave.to < wave.from) flight.wrong("to", fmt::format("{} or more, as from says", wave.from));
  return wave;
}

/// Keys that nothing would read. What is off by name may be followed by what it would read, as on the command line.
void check_pairs(SuiteJson& object, const Series& series) {
  if (series.frame >= 0 && object.has("cameras")) object.wrong("cameras", "none beside a frame, which has its own");
  if (series.flight)
    for (const char* key : {"lights", "cameras", "frame"})
      if (object.has(key)) object.wrong(key, "none where there is a flight, which has its own");
  if (!object.has("mirror") && object.has("mirror_lists")) object.wrong("mirror_lists", "none without mirror");
  const std::string& filter = series.shadows.filter;
  const bool casts = object.has("shadows");
  if (!casts && object.has("atlas")) object.wrong("atlas", "none without shadows");
  for (const ShadowWord& word : SHADOW_WORDS)
    if (!casts && object.has(word.name)) object.wrong(word.name, "none without shadows");
  if ((filter == "hard" || filter == "pcf") && object.has("shadow_blur"))
    object.wrong("shadow_blur", fmt::format("none with {}, which is filtered where it is looked up", filter));
}

/// A Culler is given lights alone here; a frame of another size is of one view with one sample a pixel.
void check_hosts(SuiteJson& object, const Series& series) {
  for (const SuiteMethod& method : series.methods) {
    const std::string who = fmt::format("with host {}", host_names()[static_cast<std::size_t>(method.host)]);
    if (method.host == Host::changing_size && series.stereo_m > 0.0) object.wrong("stereo", "0 " + who);
    if (method.host == Host::changing_size && series.depth_samples != 1) object.wrong("depth_samples", "1 " + who);
    if (!has_culler(method.host)) continue;
    if (series.decals != std::vector<std::uint32_t>{0}) object.wrong("decals", "none " + who);
    if (series.probes != std::vector<std::uint32_t>{0}) object.wrong("probes", "none " + who);
    const std::vector<std::string> paths = paths_of(series, method);
    if (std::ranges::find(paths, "tiled-deferred") == paths.end()) continue;
    if (method.path.empty()) object.wrong("paths", "no tiled-deferred " + who);
    throw Error(
        fmt::format("{}: method {}: path: expected none of tiled-deferred {}", object.where(), method.name, who));
  }
}

template <class Value>
void check_once(SuiteJson& object, const char* key, std::vector<Value> values) {
  std::ranges::sort(values);
  const auto twice = std::ranges::adjacent_find(values);
  if (twice != values.end()) object.wrong(key, fmt::format("{} once", *twice));
}

/// What is measured twice would be one line of a chart, and one result when a run goes on.
void check_repeats(SuiteJson& object, const Series& series) {
  check_once(object, "scenes", series.scenes);
  check_once(object, "sizes", series.sizes);
  check_once(object, "lights", series.lights);
  check_once(object, "spots", series.spots);
  check_once(object, "decals", series.decals);
  check_once(object, "probes", series.probes);
  check_once(object, "ranges", series.ranges);
  check_once(object, "cameras", series.cameras);
  check_once(object, "projections", series.projections);
  check_once(object, "paths", series.paths);
  if (object.has("options")) {
    SuiteJson options(object.at("options"), object.where() + ": options");
    for (const auto& [key, values] : series.options) check_once(options, key.c_str(), values);
  }
  if (configurations(series) > static_cast<double>(MOST_CONFIGURATIONS)) return;  // it is refused for that
  std::map<std::string, std::string> labels;
  for (const SuiteMethod& method : series.methods)
    for (const std::string& path : paths_of(series, method)) {
      std::vector<std::string> words = method.options;
      std::ranges::sort(words);
      words.insert(words.end(), {method.name, path, method.still_lists, std::to_string(method.still_occlusion),
                                 std::to_string(method.still_bytes), std::to_string(static_cast<int>(method.host))});
      const auto [first, is_new] = labels.emplace(fmt::format("{}", fmt::join(words, "\n")), method.label);
      if (!is_new)
        throw Error(fmt::format("{}: methods: '{}' and '{}' ask for the same, by the path {}; expected it once",
                                object.where(), first->second, method.label, path));
    }
}

Series parse_series(const json& value, const std::string& source) {
  std::string where = source + ": series";
  if (value.is_object() && value.contains("name") && value["name"].is_string())
    where += fmt::format(" '{}'", value["name"].get<std::string>());
  SuiteJson object(value, where);
  Series series;
  object.require("name", series.name);
  series.title = series.name;
  object.read("title", series.title);
  object.read("about", series.about);
  series.methods = parse_methods(object);
  series.options = parse_options(object);
  object.read("scenes", series.scenes);
  object.read("sizes", series.sizes);
  object.read("lights", series.lights, 0, MAX_LIGHTS);
  object.read("spots", series.spots, 0.0, 1.0);
  object.read("decals", series.decals, 0, MAX_BOXES);
  object.read("probes", series.probes, 0, MAX_BOXES);
  object.read("still", series.still, 0.0, 1.0);
  object.read("ranges", series.ranges);
  object.read("cameras", series.cameras);
  object.read("projections", series.projections);
  object.read("paths", series.paths);
  object.read("brdf", series.brdf);
  object.read("depth", series.depth);
  object.read("depth_samples", series.depth_samples, 1, 8);
  object.read("stereo", series.stereo_m, 0.0, 1000.0);
  for (const ShadowWord& word : SHADOW_WORDS) object.read(word.name, series.shadows.*word.value);
  object.read("atlas", series.shadows.atlas, 16, 32768);
  object.read("mirror", series.mirror, 0.0, 1.0);
  object.read("mirror_lists", series.mirror_lists);
  if (std::ranges::find(mirror_list_names(), series.mirror_lists) == mirror_list_names().end())
    object.wrong("mirror_lists", joined(mirror_list_names()));
  object.read("seed", series.seed);
  std::uint32_t frame = ~0U;
  object.read("frame", frame, 0, MAX_FRAMES);
  if (frame != ~0U) series.frame = static_cast<int>(frame);
  object.read("frames", series.frames, 1, MAX_FRAMES);
  object.read("warm_up", series.warm_up, 0, MAX_FRAMES);
  object.read("timed", series.timed);
  series.flight = parse_flight(object);
  const bool has_lists = std::ranges::any_of(series.methods, [](const auto& m) { return m.still_lists != "off"; });
  if (series.flight && series.still > 0.0) object.wrong("still", "0 where there is a flight");
  if (has_lists && series.still == 0.0) object.wrong("still", "more than 0 where a method has still_lists");
  if (object.has("chart")) series.chart = parse_chart(object.at("chart"), series, where);
  check_pairs(object, series);
  check_hosts(object, series);
  check_repeats(object, series);
  series.verify = parse_verify(object);
  if (!series.timed && (series.flight || object.has("verify") || object.has("pictures")))
    object.wrong("timed", "true where there is a flight, something to verify, or pictures");
  if (!series.timed && (object.has("frames") || object.has("warm_up")))
    object.wrong("timed", "true where there are frames, or a warm_up");
  object.read("pictures", series.pictures);
  object.finish();
  return series;
}

/// What series multiply out to: a short text can give more than memory holds.
struct Size {
  double count = 0.0;  ///< configurations
  double bytes = 0.0;  ///< of their texts, about

  void add(const Series& series, std::size_t text_bytes, const std::string& source) {
    constexpr double MOST_BYTES = 1U << 30;
    count += configurations(series);
    bytes += configurations(series) * static_cast<double>(text_bytes);
    if (count <= static_cast<double>(MOST_CONFIGURATIONS) && bytes <= MOST_BYTES) return;
    throw Error(
        fmt::format("{}: series '{}': multiplies the suite out to {:.0f} configurations and {:.0f} bytes of text, "
                    "expected at most {} and {:.0f}",
                    source, series.name, count, bytes, MOST_CONFIGURATIONS, MOST_BYTES));
  }
};

/// The file of a built-in suite, or nothing.
const EmbeddedFile* builtin_suite(const std::string& name) {
  const auto found = std::ranges::find(suite_files(), name + ".json", &EmbeddedFile::name);
  return found == suite_files().end() ? nullptr : &*found;
}

}  // namespace

std::span<const std::string_view> chart_values() { return VALUES; }

std::vector<std::string> paths_of(const Series& series, const SuiteMethod& method) {
  return method.path.empty() ? series.paths : std::vector{method.path};
}

Suite parse_suite(std::string_view text, const std::string& source) {
  const json document = parse_json(text, source);
  SuiteJson object(document, source);
  if (!object.has("version") || object.at("version") != 1) object.wrong("version", "1");
  Suite suite;
  object.require("name", suite.name);
  suite.title = suite.name;
  object.read("title", suite.title);
  object.read("about", suite.about);
  object.read("source", suite.source);
  if (!object.has("series")) throw Error(source + ": series: is missing; expected a list of series");
  if (!object.at("series").is_array() || object.at("series").empty()) object.wrong("series", "a list of series");
  object.finish();
  std::set<std::string> names;
  Size size;
  for (const json& value : object.at("series")) {
    suite.series.push_back(parse_series(value, source));
    size.add(suite.series.back(), value.dump().size(), source);
    if (!names.insert(suite.series.back().name).second)
      throw Error(fmt::format("{}: series '{}': has the name of another", source, suite.series.back().name));
  }
  return suite;
}

std::vector<std::string> suite_names() {
  std::vector<std::string> names;
  for (const EmbeddedFile& file : suite_files()) names.emplace_back(file.name.substr(0, file.name.rfind('.')));
  return names;
}

bool is_suite(const std::string& name) { return name.ends_with(".json") || builtin_suite(name) != nullptr; }

Suite load_suite(const std::string& name) {
  if (const EmbeddedFile* builtin = builtin_suite(name)) return parse_suite(builtin->text, "suite " + name);
  const std::string expected = fmt::format("a suite's file, or one of {}", fmt::join(suite_names(), ", "));
  return within_memory(name, [&] {
    return parse_suite(text_of(read_file(utf8_path(name), {.expected = expected, .most_bytes = LARGEST_SUITE})), name);
  });
}

Suite scene_suite(Series series) {
  Suite suite{.name = "scene", .title = series.title, .about = series.about};
  suite.series.push_back(std::move(series));
  return suite;
}

}  // namespace lamp::app
