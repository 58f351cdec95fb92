// A candidate as JSON.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "bench/results.h"
#include "commands/auto_method.h"
#include "commands/bench_candidate.h"
#include "commands/stats.h"

namespace lamp::app {
namespace {

using nlohmann::json;

json spread_json(const FrameTimes& times, const auto& value) { return to_json(spread_of(values_of(times, value))); }

json times_json(const Candidate& candidate) {
  if (!candidate.timed()) return nullptr;
  const FrameTimes& t = candidate.times;
  return {{"cull", spread_json(t, [](const FrameTime& f) { return f.cull_ms; })},
          {"shade", spread_json(t, [](const FrameTime& f) { return f.shade_ms; })},
          {"cull+shade", spread_json(t, cull_and_shade)},
          {"frame", spread_json(t, [](const FrameTime& f) { return f.frame_ms; })}};
}

/// Every frame of a flight by itself.
json samples_json(const Candidate& candidate) {
  json samples = json::array();
  for (std::size_t i = 0; i < candidate.frames.size(); ++i) {
    const FrameTime& time = candidate.times.frames()[i];
    samples.push_back({{"frame", candidate.frames[i].first},
                       {"lights", candidate.frames[i].second},
                       {"cull", time.cull_ms},
                       {"shade", time.shade_ms},
                       {"frame_ms", time.frame_ms}});
  }
  return samples;
}

json parameters_json(const Group& group, const GroupEntry& entry) {
  json parameters{{"scene", group.scene},
                  {"size", group.size},
                  {"lights", group.lights},
                  {"spots", group.spots},
                  {"range", group.range.empty() ? "automatic" : group.range},
                  {"camera", group.camera.empty() ? "first" : group.camera},
                  {"projection", group.projection},
                  {"path", entry.path},
                  {"method", entry.name}};
  if (group.seed != Series{}.seed) parameters["seed"] = group.seed;
  if (group.brdf != Series{}.brdf) parameters["brdf"] = group.brdf;
  if (group.frame >= 0) parameters["frame"] = group.frame;
  if (group.depth != "reversed") parameters["depth"] = group.depth;
  if (group.depth_samples != 1) parameters["depth_samples"] = group.depth_samples;
  if (group.still != 0.0) parameters["still"] = group.still;
  if (group.decals != 0) parameters["decals"] = group.decals;
  if (group.probes != 0) parameters["probes"] = group.probes;
  if (entry.still_lists != "off") parameters["still_lists"] = entry.still_lists;
  if (entry.still_occlusion != 0) parameters["still_occlusion"] = entry.still_occlusion;
  if (entry.still_bytes != SuiteMethod{}.still_bytes) parameters["still_bytes"] = entry.still_bytes;
  if (group.stereo_m != 0.0) parameters["stereo"] = group.stereo_m;
  const ShadowChoice usual;
  for (const auto& [name, value] : SHADOW_WORDS)
    if (group.shadows.filter != usual.filter && group.shadows.*value != usual.*value)
      parameters[name] = group.shadows.*value;
  if (group.shadows.filter != usual.filter) parameters["atlas"] = group.shadows.atlas;
  if (group.mirror != 0.0) parameters["mirror"] = group.mirror;
  if (group.mirror != 0.0) parameters["mirror_lists"] = group.mirror_lists;
  if (entry.host != Host::plan) parameters["host"] = host_names()[static_cast<std::size_t>(entry.host)];
  for (const auto& [key, value] : entry.swept) parameters["option:" + key] = value;
  return parameters;
}

/// Stats of an entry; one whose output was wrong has no times.
json stats_json(const MeasureInfo& info, Candidate& candidate, const BenchFrame& frame) {
  if (!candidate.lighting) return json::object();
  Rendered rendered = std::move(candidate.checked.rendered);
  rendered.passes.clear();
  candidate.times.fill(rendered, *candidate.lighting);
  const BenchScene& scene = info.device.scene(info.group);
  Stats stats = make_stats({.device = info.device.context().row(),
                            .scene = info.group.scene,
                            .view = frame.view(),
                            .lights = light_capacity(scene, info.group),
                            .frames = static_cast<std::uint32_t>(candidate.frames.size()),
                            .decals = scene.decals.size(),
                            .probes = scene.probes.size()},
                           *candidate.lighting, std::move(rendered));
  stats.findings = candidate.checked.findings;
  stats.decal_findings = candidate.checked.decals;
  stats.probe_findings = candidate.checked.probes;
  if (candidate.still) stats.still = still_stats(*candidate.still);
  if (stats.findings) stats.verifier = info.group.verify.verifier;
  stats.image_max_abs_diff = candidate.checked.difference;
  json made = to_json(stats);
  if (!candidate.timed())
    for (const char* key : {"cull_ms", "shade_ms", "frame_ms"}) made[key] = nullptr;
  return made;
}

/// What was held against what; of other outputs than were checked nothing.
std::string verified_words(const Group& group, const Candidate& candidate) {
  const std::string& verdict = candidate.checked.verdict;
  return verdict == "unverified" || verdict == "impossible" ? "nothing" : words_of(group.verify);
}

}  // namespace

bool has_auto(const Group& group) { return std::ranges::any_of(group.entries, is_auto, &GroupEntry::name); }

std::string full_label(const GroupEntry& entry) {
  std::string label = entry.label;
  for (const auto& [key, value] : entry.swept) label += fmt::format(" {}={}", key, value);
  return label;
}

json result_json(const MeasureInfo& info, Candidate& candidate, const BenchFrame& frame) {
  json result{{"series", info.group.series},
              {"key", key_of(info.group, *candidate.entry)},
              {"label", candidate.entry->label},
              {"parameters", parameters_json(info.group, *candidate.entry)},
              {"verified", verified_words(info.group, candidate)},
              {"verdict", candidate.checked.verdict},
              {"reason", candidate.checked.reason},
              {"times", times_json(candidate)},
              {"stats", stats_json(info, candidate, frame)}};
  if (json hashes = hashes_of(info.group, *candidate.entry); !hashes.empty()) result["hashes"] = std::move(hashes);
  if (candidate.clock_moved) result["clock_moved"] = true;
  if (info.group.flight && candidate.timed()) result["samples"] = samples_json(candidate);
  if (has_auto(info.group) && candidate.timed()) result["rounds"] = values_of(candidate.times, cull_and_shade);
  return result;
}

}  // namespace lamp::app
