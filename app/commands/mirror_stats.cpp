// Says what mirrored light came to.
// SPDX-License-Identifier: Apache-2.0
#include "commands/mirror_stats.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

#include "commands/stats.h"

namespace lamp::app {
namespace {

std::string_view list_name(const MirrorSettings& settings) {
  return mirror_list_names()[static_cast<std::size_t>(settings.lists)];
}

nlohmann::json to_json(const MirrorFindings& f) {
  nlohmann::json json{{"rays", f.rays},
                      {"checked", f.checked},
                      {"hits", f.hits},
                      {"wrong", f.wrong},
                      {"unclear", f.unclear},
                      {"ended", f.ended},
                      {"verdict", name_of(f.verdict())},
                      {"reason", f.reason()}};
  if (!f.lists) return json;
  const double waste = f.lists->waste();
  json["lists"] = {{"missed", f.lists->missed},
                   {"walked", f.lists->evaluations},
                   {"useful", f.lists->useful},
                   {"waste", std::isfinite(waste) ? nlohmann::json(waste) : nlohmann::json(nullptr)},
                   {"longest", f.lists->list_max}};
  return json;
}

}  // namespace

std::optional<MirrorStats> mirror_stats(const MirrorPass* mirror) {
  if (mirror == nullptr) return std::nullopt;
  return MirrorStats{.settings = mirror->info().settings,
                     .counts = mirror->counts(),
                     .overflowed_cells = mirror->overflowed_cells(),
                     .bytes = mirror->bytes(),
                     .notes = mirror->scene().notes()};
}

std::string mirror_words(const MirrorStats& stats) {
  std::uint64_t bytes = 0;
  for (const auto& [name, size] : stats.bytes) bytes += size;
  std::string words = fmt::format("{} rays, {} meet something; lists of {}, {:.1f} MB in all", stats.counts.rays,
                                  stats.counts.hits, list_name(stats.settings), static_cast<double>(bytes) * 1e-6);
  if (stats.counts.ended != 0)
    words += fmt::format("; the device ended the search of {}, which see the sky", stats.counts.ended);
  if (stats.overflowed_cells != 0)
    words += fmt::format("; {} did not fit, whose hits walk every light", cell_words(stats.overflowed_cells));
  return words;
}

std::string mirror_words(const MirrorFindings& f) {
  std::string words = fmt::format("{} of {} rays held against a reference: {} meet something else, {} hang on rounding",
                                  f.checked, f.rays, f.wrong, f.unclear);
  if (f.lists)
    words += fmt::format("; at {} hits {} lights walked, {} reach them (waste {:.2f}), {} missed", f.hits,
                         f.lists->evaluations, f.lists->useful, f.lists->waste(), f.lists->missed);
  return words;
}

nlohmann::json to_json(const MirrorStats& stats) {
  nlohmann::json json{{"roughness", stats.settings.roughness},
                      {"lists", list_name(stats.settings)},
                      {"rays", stats.counts.rays},
                      {"hits", stats.counts.hits},
                      {"ended", stats.counts.ended},
                      {"overflowed_cells", stats.overflowed_cells},
                      {"bytes", nlohmann::json::object()},
                      {"notes", stats.notes}};
  for (const auto& [name, bytes] : stats.bytes) json["bytes"][name] = bytes;
  if (stats.findings) json["check"] = to_json(*stats.findings);
  return json;
}

}  // namespace lamp::app
