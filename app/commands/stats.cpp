// Stats to JSON.
// SPDX-License-Identifier: Apache-2.0
#include "commands/stats.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "gpu/check.h"

namespace lamp::app {
namespace {

/// Drivers name them "Register Count" or "VGPRs", and "Occupancy" or "Subgroups per SIMD".
bool counts_registers(const std::string& name) {
  return name.find("egister Count") != std::string::npos || name == "VGPRs";
}
bool is_occupancy(const std::string& name) {
  return name.find("ccupancy") != std::string::npos || name == "Subgroups per SIMD";
}

/// The driver's numbers by their names; `registers`, the most of its stages, and `occupancy`, the least, where it has
/// them.
void add_statistics(nlohmann::json& json, const PassTime& pass) {
  for (const vulkan::PipelineStatistic& s : pass.statistics) {
    json["statistics"].push_back({{"executable", s.executable}, {"name", s.name}, {"value", s.value}});
    if (counts_registers(s.name)) json["registers"] = std::max(json.value("registers", 0.0), s.value);
    if (is_occupancy(s.name)) json["occupancy"] = std::min(json.value("occupancy", s.value), s.value);
  }
}

nlohmann::json options_json(const Options& options) {
  nlohmann::json json = nlohmann::json::object();
  for (const auto& [key, value] : options.all()) json[key] = value;
  return json;
}

std::optional<TransparentStats> transparent_stats(const Lighting& lighting, const vulkan::FrameCounts& counted) {
  if (lighting.any_depth_method() == nullptr) return std::nullopt;
  return TransparentStats{.method = std::string(lighting.any_depth_method()->name),
                          .options = lighting.any_depth_options(),
                          .bytes = lighting.any_depth_plan().bytes(),
                          .overflowed_cells = counted.counters.overflowed_cells,
                          .can_grow = lighting.any_depth_grown(counted.needed).has_value()};
}

nlohmann::json to_json(const TransparentStats& stats) {
  return {{"method", stats.method},
          {"options", options_json(stats.options)},
          {"bytes", stats.bytes},
          {"overflowed_cells", stats.overflowed_cells}};
}

constexpr const char* NOT_COUNTED =
    "not counted: lists are wrong, walks were ended, or pixels of a cell walk different lists";

}  // namespace

std::string words_of(std::span<const std::pair<std::string, std::string>> settings) {
  std::string words;
  for (const auto& [key, value] : settings) words += fmt::format("{}{}={}", words.empty() ? "" : ", ", key, value);
  return words;
}

std::string cell_words(std::uint64_t count) { return fmt::format("{} cell{}", count, count == 1 ? "" : "s"); }

std::string overflow_words(const Stats& stats) {
  return fmt::format("{} did not fit and walked more lights{}{}", cell_words(stats.rendered.counters.overflowed_cells),
                     stats.fits_with.empty() ? "" : "; there is room with ", words_of(stats.fits_with));
}

std::string overflow_words(const TransparentStats& stats) {
  return fmt::format("of transparent surfaces' own lists {} did not fit and walked more lights{}",
                     cell_words(stats.overflowed_cells), stats.can_grow ? "; --grow makes room" : "");
}

std::uint32_t overflowed_cells(const Stats& stats) {
  return stats.rendered.counters.overflowed_cells + (stats.transparent ? stats.transparent->overflowed_cells : 0);
}

std::vector<std::string> all_overflow_words(const Stats& stats) {
  std::vector<std::string> words;
  if (stats.rendered.counters.overflowed_cells != 0) words.push_back(overflow_words(stats));
  if (stats.transparent && stats.transparent->overflowed_cells != 0)
    words.push_back(overflow_words(*stats.transparent));
  return words;
}

Stats make_stats(const StatsInfo& info, Lighting& lighting, Rendered rendered) {
  const Plan& plan = lighting.runner().plan();
  Stats stats{.device = info.device.name,
              .driver = info.device.driver,
              .scene = info.scene,
              .method = std::string(lighting.info().method->name),
              .options = lighting.info().options,
              .path = std::string(path_names()[static_cast<std::size_t>(lighting.info().path)]),
              .width = info.view.width(),
              .height = info.view.height(),
              .lights = info.lights,
              .decals = info.decals,
              .probes = info.probes,
              .frames = info.frames,
              .rendered = std::move(rendered),
              .cells = plan.cells,
              .notes = plan.notes,
              .ordered = plan.ordered,
              .approximate = plan.approximate};
  if (const auto& grown = lighting.info().grown; !grown.empty())
    stats.notes.push_back("room was made with " + words_of(grown));
  if (const auto& options = lighting.info().any_depth_options)
    stats.notes.push_back("room was made for transparent surfaces with " +
                          words_of(changed_options(take(resolve_options(*lighting.any_depth_method(), {})), *options)));
  stats.rendered.image.pixels = {};
  stats.transparent = transparent_stats(lighting, stats.rendered.any_depth);
  stats.fits_with = lighting.fits_with(stats.rendered.needed);
  for (const BufferDesc& buffer : plan.buffers) stats.bytes.emplace_back(buffer.name, plan.bytes_of(buffer));
  stats.bytes.emplace_back("total", plan.bytes());
  return stats;
}

Stats make_stats(const Request& request, Session& session, Lighting& lighting, const Setup& setup, Rendered rendered,
                 std::uint32_t frames) {
  Stats stats = make_stats({.device = session.context().row(),
                            .scene = request.scene,
                            .view = setup.view,
                            .lights = setup.lights.size(),
                            .frames = frames,
                            .decals = setup.decals.size(),
                            .probes = setup.probes.size()},
                           lighting, std::move(rendered));
  stats.views = setup.views.size();
  stats.shadows = shadow_stats(session.renderer().shadows());
  stats.mirror = mirror_stats(session.renderer().mirrored());
  if (session.captures() != nullptr) stats.captures = session.captures()->counts();
  if (session.still() != nullptr) stats.still = still_stats(*session.still());
  return stats;
}

void set_walked(Stats& stats, std::span<const Visit> visits) {
  const auto width = static_cast<std::uint32_t>(visits.size() / stats.height);  // several views side by side
  Verification verification(width);
  verification.add(empty_truth(width, stats.height), visits);
  stats.findings = verification.findings();
  if (stats.findings->unfollowed != 0)
    stats.notes.push_back(fmt::format(
        "the device ended the walks of {} pixels before their end, the first: {}; a heat map shows what they "
        "had until then, other numbers leave them out",
        stats.findings->unfollowed, stats.findings->first_unfollowed));
}

void add_number(nlohmann::json& json, const std::string& key, std::optional<double> value, const char* reason) {
  const bool is_number = value && std::isfinite(*value);
  json[key] = is_number ? nlohmann::json(*value) : nlohmann::json();
  if (!is_number) json[key + "_reason"] = reason;
}

nlohmann::json to_json(const Stats& s) {
  nlohmann::json json{{"device", s.device},
                      {"driver", s.driver},
                      {"scene", s.scene},
                      {"method", s.method},
                      {"options", options_json(s.options)},
                      {"path", s.path},
                      {"width", s.width},
                      {"height", s.height},
                      {"views", s.views},
                      {"lights", s.lights},
                      {"decals", s.decals},
                      {"probes", s.probes},
                      {"frames", s.frames},
                      {"passes", nlohmann::json::array()},
                      {"cull_ms", s.rendered.cull_ms},
                      {"shade_ms", s.rendered.shade_ms},
                      {"frame_ms", s.rendered.frame_ms},
                      {"bytes", nlohmann::json::object()},
                      {"cells", s.cells},
                      {"notes", s.notes},
                      {"approximate", s.approximate},
                      {"ordered", s.ordered},
                      {"overflowed_cells", s.rendered.counters.overflowed_cells}};
  for (const auto& [key, value] : s.fits_with) json["fits_with"][key] = value;
  for (const PassTime& pass : s.rendered.passes)
    json["passes"].push_back({{"name", pass.name},
                              {"part", pass.host    ? "host"
                                       : pass.cull  ? "cull"
                                       : pass.shade ? "shade"
                                                    : "other"},
                              {"ms_median", pass.ms_median},
                              {"ms_p5", pass.ms_p5},
                              {"ms_p95", pass.ms_p95}});
  for (std::size_t i = 0; i < s.rendered.passes.size(); ++i) add_statistics(json["passes"][i], s.rendered.passes[i]);
  for (const auto& [name, bytes] : s.bytes) json["bytes"][name] = bytes;
  if (s.findings) {
    const Findings& f = *s.findings;
    json["evaluations"] = f.evaluations;
    json["list_mean"] = f.list_mean();
    json["list_max"] = f.list_max;
    json["unfollowed"] = f.unfollowed;
    if (s.verifier) {
      json.update({{"verifier", name_of(*s.verifier)},
                   {"missed", f.missed},
                   {"useful", f.useful},
                   {"boundary_pairs", f.boundary_pairs}});
      add_number(json, "waste", f.waste(), NONE_USEFUL);
      add_number(json, "excess", f.excess(), f.excess() ? NONE_USEFUL : NOT_COUNTED);
      if (s.verifier == Verifier::gpu) json["repeated"] = f.repeated;
      if (f.changed_runs) json["changed_runs"] = *f.changed_runs;
    }
    if (f.missed_fused) json["missed_fused"] = *f.missed_fused;
  }
  if (s.shadows) json["shadows"] = to_json(*s.shadows);
  if (s.transparent) json["transparent"] = to_json(*s.transparent);
  if (s.mirror) json["mirror"] = to_json(*s.mirror);
  if (s.still) json["still"] = to_json(*s.still);
  if (s.captures)
    json["probe_captures"] = {{"captured", s.captures->captured},
                              {"drawn", s.captures->drawn},
                              {"waiting", s.captures->waiting},
                              {"longest_wait", s.captures->longest_wait}};
  if (s.judgement) json.update({{"verdict", name_of(s.judgement->verdict)}, {"reason", s.judgement->reason}});
  if (s.decal_findings)
    json.update({{"decals_missed", s.decal_findings->missed},
                 {"decal_evaluations", s.decal_findings->evaluations},
                 {"decals_useful", s.decal_findings->useful},
                 {"decals_boundary_pairs", s.decal_findings->boundary_pairs}});
  if (s.probe_findings)
    json.update({{"probes_missed", s.probe_findings->missed},
                 {"probe_evaluations", s.probe_findings->evaluations},
                 {"probes_useful", s.probe_findings->useful},
                 {"probes_boundary_pairs", s.probe_findings->boundary_pairs}});
  if (s.image_max_abs_diff) add_number(json, "image_max_abs_diff", *s.image_max_abs_diff, NOT_FINITE);
  if (s.clock) {
    add_number(json, "clock_mhz", s.clock->now_mhz, CLOCK_UNTOLD);
    add_number(json, "clock_most_mhz", s.clock->most_mhz, CLOCK_UNTOLD);
  }
  if (s.image_tolerance) json["image_tolerance"] = *s.image_tolerance;
  return json;
}

}  // namespace lamp::app
