// Puts data, charts, style and script into the template.
// SPDX-License-Identifier: Apache-2.0
#include "bench/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "bench/chart_lines.h"
#include "bench/comparison.h"
#include "bench/embedded_files.h"
#include "bench/suite.h"
#include "bench/summary.h"
#include "error.h"
#include "files/read_file.h"
#include "files/utf8_path.h"

namespace lamp::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string_view part(std::string_view name) {
  const auto found = std::ranges::find(report_files(), name, &EmbeddedFile::name);
  assert(found != report_files().end() && "bench/report and the chart library are embedded by the build");
  return found->text;
}

/// The page's scripts, those that are used first.
std::string script() {
  std::string text;
  for (const char* name : {"base.js", "charts.js", "flight.js", "pictures.js", "tables.js", "page.js"})
    text += part(name);
  return text;
}

/// RFC 4648.
std::string base64(std::string_view bytes) {
  constexpr std::string_view DIGITS = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t word = 0;
    for (std::size_t j = 0; j < 3; ++j) word = word << 8U | (j < count ? static_cast<unsigned char>(bytes[i + j]) : 0U);
    for (std::size_t j = 0; j < 4; ++j) text += j <= count ? DIGITS[word >> (18U - 6U * j) & 63U] : '=';
  }
  return text;
}

/// Whether a file lies below a folder once all links are followed.
bool lies_below(const fs::path& file, const fs::path& folder) {
  return stays_below(fs::canonical(file).lexically_relative(fs::canonical(folder)));
}

/// The bytes of a picture that results name, or nothing when it is gone. A page is made to be sent: nothing but
/// pictures of the results' own folder may come into it. Throws Error that begins with `where`.
std::optional<std::vector<std::byte>> read_picture(const fs::path& folder, const std::string& name,
                                                   const std::string& where) {
  constexpr std::uint64_t LARGEST = 1U << 26;  // bytes
  constexpr std::string_view SIGNATURE = "\x89PNG\r\n\x1a\n";
  const auto fail = [&] {
    throw Error(
        fmt::format("{} is '{}', expected the name of a PNG file below the folder of results.json", where, name));
  };
  if (!stays_below(utf8_path(name))) fail();
  const fs::path file = folder / utf8_path(name);
  std::error_code error;
  if (!fs::exists(file, error)) return std::nullopt;
  if (!lies_below(file, folder)) fail();
  std::vector<std::byte> bytes =
      read_file(file, {.name = fmt::format("{}: '{}'", where, name), .expected = "a PNG file", .most_bytes = LARGEST});
  if (!text_of(bytes).starts_with(SIGNATURE)) fail();
  return bytes;
}

/// Pictures of all runs, each kept once: methods that are right draw the same.
class Pictures {
 public:
  /// The place among all() of a picture of a result, or null when the file is gone.
  json add(const ReportRun& run, std::size_t result, const std::string& kind, const std::string& name) {
    const fs::path folder = run.file.has_parent_path() ? run.file.parent_path() : fs::path(".");
    const auto bytes =
        read_picture(folder, name, fmt::format("{}: result {}: pictures {}", run.file.string(), result, kind));
    if (!bytes) return nullptr;
    const auto [found, fresh] = places_.emplace(text_of(*bytes), all_.size());
    if (fresh) all_.push_back("data:image/png;base64," + base64(text_of(*bytes)));
    return found->second;
  }
  [[nodiscard]] const json& all() const { return all_; }

 private:
  std::map<std::string, std::size_t> places_;
  json all_ = json::array();
};

json run_json(const ReportRun& run, Pictures& pictures) {
  json data = run.results;
  json& results = data.at("results");
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (!results[i].contains("pictures")) continue;
    for (auto& [kind, name] : results[i]["pictures"].items())
      name = pictures.add(run, i, kind, name.get<std::string>());
  }
  data["file"] = run.file.string();
  data["summary"] = run_summary(run.results);
  data["panels"] = json::array();
  for (const ChartPanel& panel : chart_panels(run.results, run.file.string())) {
    json made = to_json(panel);
    made["summary"] = panel_summary(run.results, panel);
    made["trends"] = json::array();
    if (panel.flight)
      for (const Trend& trend : trends(run.results, panel)) {
        json points = json::array();
        for (const Point& point : trend.average) points.push_back({point.x, point.y});
        made["trends"].push_back({{"label", trend.label}, {"points", points}});
      }
    data["panels"].push_back(made);
  }
  return data;
}

/// JSON that may stand in a script element: nothing in it can end the element.
std::string script_safe(const json& data) {
  const std::string text = data.dump(-1, ' ', /* ensure_ascii= */ true, json::error_handler_t::replace);
  std::string safe;
  for (const char c : text) safe += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return safe;
}

std::string html_escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '<')
      safe += "&lt;";
    else if (c == '&')
      safe += "&amp;";
    else
      safe += c;
  }
  return safe;
}

/// The template with every @NAME@ replaced, each once: what is put in is not searched again.
std::string filled(std::string_view text, const std::vector<std::pair<std::string, std::string>>& values) {
  std::string out;
  for (const auto& [name, value] : values) {
    const std::size_t at = text.find("@" + name + "@");
    assert(at != std::string_view::npos && "bench/report/report.html holds every part, in the order of report_html");
    out += text.substr(0, at);
    out += value;
    text.remove_prefix(at + name.size() + 2);
  }
  return out += text;
}

}  // namespace

std::string report_html(std::span<const ReportRun> runs) {
  assert((runs.size() == 1 || runs.size() == 2) && "report one run, or compare two");
  Pictures pictures;
  json data{{"runs", json::array()}};
  try {
    for (const ReportRun& run : runs) data["runs"].push_back(run_json(run, pictures));
    if (runs.size() == 2) data["comparison"] = to_json(compare_runs(runs[0].results, runs[1].results));
  } catch (const json::exception& error) {
    throw Error(fmt::format("{}: is damaged: {}; expected a results.json as lamp bench writes it",
                            runs[data["runs"].size() == runs.size() ? 0 : data["runs"].size()].file.string(),
                            error.what()));
  }
  data["images"] = pictures.all();
  json words = json::object();
  for (const std::string_view y : chart_values()) words[std::string(y)] = words_of(std::string(y));
  data["words"] = words;
  const std::string title = data["runs"][0]["suite"].value("title", "Lamplight");
  return filled(part("report.html"), {{"TITLE", html_escaped(title)},
                                      {"STYLE", std::string(part("report.css"))},
                                      {"DATA", script_safe(data)},
                                      {"CHARTS", std::string(part("chart.min.js"))},
                                      {"SCRIPT", script()}});
}

}  // namespace lamp::app
