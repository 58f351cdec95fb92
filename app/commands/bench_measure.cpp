// Check, warm up, then rounds: every entry once a frame, all on the same lights, which move from frame to frame.
// SPDX-License-Identifier: Apache-2.0
#include "commands/bench_measure.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <list>
#include <memory>

#include "bench/results.h"
#include "commands/bench_check.h"
#include "commands/bench_pictures.h"
#include "commands/stats.h"
#include "gpu/check.h"
#include "render/frame_times.h"

namespace lamp::app {
namespace {

using nlohmann::json;

/// An entry whose frames took the GPU this long together has had enough of them once FEWEST_FRAMES are timed: one that
/// walks a million lights a pixel would take longer than all others together. A flight needs each of its frames.
constexpr double LONGEST_MS = 2000.0;
constexpr std::size_t FEWEST_FRAMES = 3;
/// How often a group is measured whose times say that the GPU's clock moved.
constexpr int MOST_TRIES = 3;

/// An entry under measurement.
struct Candidate {
  const GroupEntry* entry = nullptr;
  std::optional<Lighting> lighting;  ///< nothing: it cannot run here
  std::optional<StillSetup> still;   ///< where lights that stand still have lists of their own
  std::unique_ptr<StillLists> still_lists;
  Checked checked;
  FrameTimes times;
  std::vector<std::pair<std::uint32_t, std::size_t>> frames;  ///< number and lights of each timed frame
  bool rendered = true;                                       ///< false: the series asks for its plan alone
  double spent_ms = 0.0;                                      ///< GPU time of all frames, those of the warm-up too
  bool clock_moved = false;                                   ///< while it was timed, each time

  [[nodiscard]] bool runs() const { return lighting && rendered && checked.verdict != "wrong"; }
  [[nodiscard]] bool timed() const { return runs() && !clock_moved; }
  void forget_times(std::size_t planned) {
    times = FrameTimes(planned);
    frames.clear();
    spent_ms = 0.0;
  }
};

/// The frame whose output is checked: the middle one, of a flight the one with the most lights.
std::uint32_t checked_frame(const Group& group) {
  if (!group.flight) return group.frames / 2;
  std::uint32_t best = 0;
  for (std::uint32_t i = 0; i < group.frames; ++i)
    if (lights_at(*group.flight, i, group.frames) > lights_at(*group.flight, best, group.frames)) best = i;
  return best;
}

std::vector<double> values_of(const FrameTimes& times, const auto& value) {
  std::vector<double> values;
  for (const FrameTime& frame : times.frames()) values.push_back(value(frame));
  return values;
}

json spread_json(const FrameTimes& times, const auto& value) { return to_json(spread_of(values_of(times, value))); }

double cull_and_shade(const FrameTime& frame) { return frame.cull_ms + frame.shade_ms; }

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
                  {"method", entry.method}};
  if (group.depth != "reversed") parameters["depth"] = group.depth;
  if (group.depth_samples != 1) parameters["depth_samples"] = group.depth_samples;
  if (group.still != 0.0) parameters["still"] = group.still;
  if (group.decals != 0) parameters["decals"] = group.decals;
  if (group.probes != 0) parameters["probes"] = group.probes;
  if (entry.still_lists != "off") parameters["still_lists"] = entry.still_lists;
  if (entry.still_occlusion != 0) parameters["still_occlusion"] = entry.still_occlusion;
  if (group.stereo_m != 0.0) parameters["stereo"] = group.stereo_m;
  const ShadowChoice usual;
  for (const auto& [name, value] : SHADOW_WORDS)
    if (group.shadows.*value != usual.*value) parameters[name] = group.shadows.*value;
  if (group.shadows.filter != usual.filter) parameters["atlas"] = group.shadows.atlas;
  if (group.mirror != 0.0) parameters["mirror"] = group.mirror;
  if (group.mirror != 0.0) parameters["mirror_lists"] = group.mirror_lists;
  if (entry.host != Host::plan) parameters["host"] = host_names()[static_cast<std::size_t>(entry.host)];
  for (const auto& [key, value] : entry.swept) parameters["option:" + key] = value;
  return parameters;
}

/// The label, and what tells entries of one label apart.
std::string full_label(const GroupEntry& entry) {
  std::string label = entry.label;
  for (const auto& [key, value] : entry.swept) label += fmt::format(" {}={}", key, value);
  return label;
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

bool has_auto(const Group& group) { return std::ranges::any_of(group.entries, is_auto, &GroupEntry::method); }

json result_json(const MeasureInfo& info, Candidate& candidate, const BenchFrame& frame) {
  json result{{"series", info.group.series},
              {"key", key_of(info.group, *candidate.entry)},
              {"label", candidate.entry->label},
              {"parameters", parameters_json(info.group, *candidate.entry)},
              {"verified", words_of(info.group.verify)},
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

/// What `auto` takes for the checked frame, if somebody wants to know.
MethodChoice choose_for(const MeasureInfo& info, const BenchScene& scene, Renderer& renderer, const BenchFrame& frame) {
  if (!info.explain && !has_auto(info.group)) return {};
  const MethodChoice chosen =
      info.device.chooser().choose(renderer, {.scene = scene.scene,
                                              .view = frame.view(),
                                              .lights = frame.lights,
                                              .light_capacity = light_capacity(scene, info.group)});
  if (info.explain) info.explain(info.device.chooser().explanation());
  return chosen;
}

/// The entry with the method and options that were chosen in place of `auto`, if anything was.
GroupEntry resolved(GroupEntry entry, const MethodChoice& chosen) {
  if (!is_auto(entry.method)) return entry;
  if (chosen.method == nullptr) throw Error("auto looks at a frame's depth, and nothing is rendered here");
  entry.method = chosen.method->name;
  entry.options = chosen.options;
  return entry;
}

/// Lightings of all entries; one that the device or its own options refuse stays empty, with the reason.
std::list<Candidate> make_candidates(const MeasureInfo& info, const BenchScene& scene, const MethodChoice& chosen) {
  std::list<Candidate> candidates;
  for (const GroupEntry& entry : info.group.entries) {
    Candidate& candidate = candidates.emplace_back();
    candidate.entry = &entry;
    if (!info.group.flight) candidate.times = FrameTimes(info.group.frames);  // a flight needs the parts of every frame
    try {
      candidate.lighting.emplace(info.device.context().device(), info.device.shaders(),
                                 lighting_info(scene, info.group, resolved(entry, chosen)));
    } catch (const Error& error) {
      candidate.checked = {.verdict = "impossible", .reason = error.what()};
    }
  }
  return candidates;
}

void say(const MeasureInfo& info, const std::string& what, double share) {
  if (const int signal = info.stop(); signal != 0) throw Interrupted{signal};
  info.progress(what, share);
}

/// Before anything is timed.
void make_still_lists(const MeasureInfo& info, const BenchScene& scene, const BenchFrame& frame,
                      std::list<Candidate>& candidates) {
  Context& context = info.device.context();
  for (Candidate& candidate : candidates) {
    if (!candidate.lighting || candidate.entry->still_lists == "off") continue;
    say(info, "makes lists of still lights for " + full_label(*candidate.entry), 0.0);
    const Request request = request_of(info.group, *candidate.entry);
    candidate.still = make_still(
        request, {.scene = scene.scene,
                  .margin_m = still_margin(request, bounds(scene.scene), frame.views, context.device().traits),
                  .lights = std::span(frame.lights).last(frame.still)});
    candidate.still_lists =
        std::make_unique<StillLists>(context, candidate.still->kind(), frame.still, candidate.still->words());
  }
}

/// What is left to say about a group whose frame does not fit the device.
std::list<Candidate> all_impossible(const Group& group, const std::string& reason) {
  std::list<Candidate> candidates;
  for (const GroupEntry& entry : group.entries) {
    Candidate& candidate = candidates.emplace_back();
    candidate.entry = &entry;
    candidate.checked = {.verdict = "impossible", .reason = reason};
  }
  return candidates;
}

json pictures_of(const MeasureInfo& info, Renderer& renderer, std::list<Candidate>& candidates) {
  std::vector<LabelledLighting> shown;
  for (Candidate& candidate : candidates)
    if (candidate.lighting) shown.push_back({full_label(*candidate.entry), &*candidate.lighting});
  return shown.empty() ? json::object() : write_pictures(info.folder, info.group, renderer, shown);
}

/// Checks every candidate that can run; one whose check finds no room on the device no longer can.
void check_all(const MeasureInfo& info, std::list<Candidate>& candidates, std::optional<Checker>& checker) {
  std::size_t done = 0;
  for (Candidate& candidate : candidates) {
    say(info, "checks " + full_label(*candidate.entry),
        0.5 * static_cast<double>(done++) / static_cast<double>(candidates.size()));
    if (!candidate.lighting) continue;
    try {
      checker->show(candidate.still_lists.get());
      candidate.checked = checker->check(*candidate.lighting, candidate.entry->still_occlusion == 0);
    } catch (const Error& error) {
      candidate.lighting.reset();
      candidate.checked = {.verdict = "impossible", .reason = error.what()};
    }
  }
}

/// The same view in a quarter of the pixels.
View half_of(const View& view) {
  return take(View::create(std::max(1U, view.width() / 2), std::max(1U, view.height() / 2), view.clip_from_view(),
                           view.view_from_world()));
}

bool has_enough(const MeasureInfo& info, const Candidate& candidate, bool warm) {
  if (info.group.flight || info.device.software()) return false;
  return candidate.spent_ms > LONGEST_MS && (!warm || candidate.frames.size() >= FEWEST_FRAMES);
}

/// Frames to get warm by are others than the first that is timed: else what is drawn only where something has moved,
/// shadow maps, would be missing in that one.
std::uint32_t frame_of_round(const Group& group, std::uint32_t round) {
  if (round >= group.warm_up) return round - group.warm_up;
  return group.flight ? group.frames - 1 : group.frames + round;
}

void time_rounds(const MeasureInfo& info, Renderer& renderer, BenchScene& scene, std::list<Candidate>& candidates) {
  const std::uint32_t rounds = info.group.warm_up + info.group.frames;
  for (std::uint32_t round = 0; round < rounds; ++round) {
    const bool warm = round >= info.group.warm_up;
    const std::uint32_t number = frame_of_round(info.group, round);
    const BenchFrame frame = bench_frame(scene, info.group, number);
    const bool each_its_own = info.group.still > 0.0;  // each may have lists of still lights of its own
    if (!each_its_own) renderer.set_frame(frame.views, frame.lights, frame.decals);
    for (Candidate& candidate : candidates) {
      say(info, "times " + full_label(*candidate.entry), 0.5 + 0.5 * static_cast<double>(round) / rounds);
      if (!candidate.runs() || has_enough(info, candidate, warm)) continue;
      if (each_its_own) {
        renderer.light_still(candidate.still_lists.get());
        renderer.set_frame(frame.views, frame.lights, frame.decals);
      }
      if (candidate.entry->host == Host::changing_size) renderer.cull_as(*candidate.lighting, half_of(frame.view()));
      const std::vector<vulkan::Timestamps::Time> times =
          renderer.time(*candidate.lighting, warm ? candidate.times.next() : Timing::parts);
      candidate.spent_ms += span_ms(times);
      if (!warm) continue;
      candidate.times.add(times, *candidate.lighting);
      candidate.frames.emplace_back(number, frame.lights.size());
    }
  }
}

bool clock_moved(const std::list<Candidate>& candidates) {
  std::vector<Spread> spreads;
  for (const Candidate& candidate : candidates)
    if (candidate.runs())
      spreads.push_back(spread_of(values_of(candidate.times, [](const FrameTime& f) { return f.frame_ms; })));
  return clock_moved(spreads);
}

/// A group whose clock moved is timed again. Times of a clock that does not stand still are no one's: they are left
/// out. A flight's frames differ by themselves.
void time_group(const MeasureInfo& info, Renderer& renderer, BenchScene& scene, std::list<Candidate>& candidates) {
  for (int tries = 1; tries <= MOST_TRIES; ++tries) {
    time_rounds(info, renderer, scene, candidates);
    if (info.group.flight || info.device.software() || !clock_moved(candidates)) return;
    if (tries == MOST_TRIES) break;
    for (Candidate& candidate : candidates) candidate.forget_times(info.group.frames);
  }
  for (Candidate& candidate : candidates) {
    if (!candidate.runs()) continue;
    candidate.clock_moved = true;
    candidate.checked.reason = fmt::format("no times: the GPU's clock moved in each of {} measurements", MOST_TRIES);
  }
}

/// Plans alone: no frame is rendered, so no picture needs room on the device.
std::vector<json> plan_only(const MeasureInfo& info, BenchScene& scene) {
  const BenchFrame frame = bench_frame(scene, info.group, 0);
  std::list<Candidate> candidates = make_candidates(info, scene, {});
  std::vector<json> results;
  for (Candidate& candidate : candidates) {
    candidate.rendered = false;
    if (candidate.lighting) candidate.checked = {.verdict = "unverified", .reason = info.group.unchecked};
    results.push_back(result_json(info, candidate, frame));
  }
  return results;
}

}  // namespace

std::vector<json> measure(const MeasureInfo& info) {
  say(info, "loads " + info.group.scene, 0.0);
  BenchScene& scene = info.device.scene(info.group);
  if (info.group.frames == 0) return plan_only(info, scene);
  const BenchFrame frame = bench_frame(scene, info.group, checked_frame(info.group));
  std::optional<FlatProbes> probes;
  std::optional<Renderer> renderer;
  std::optional<Checker> checker;
  std::list<Candidate> candidates;
  try {
    renderer.emplace(info.device.context(), info.device.shaders(), *scene.gpu, frame.view().width(),
                     frame.view().height(), light_capacity(scene, info.group),
                     static_cast<std::uint32_t>(scene.decals.size()), host_depth_of(info.group));
    if (!scene.probes.empty()) {
      probes.emplace(info.device.context(), info.device.shaders(), scene.probes);
      renderer->light_probes(&probes->set);
    }
    if (const auto shadows = shadows_of(info.group, scene.scene)) renderer->cast_shadows(*shadows);
    if (const auto mirror = mirror_of(info.group, scene.scene)) renderer->mirror(*mirror);
    checker.emplace(info.device, info.group, *renderer, frame);
    candidates = make_candidates(info, scene, choose_for(info, scene, *renderer, frame));
  } catch (const Error& error) {
    candidates = all_impossible(info.group, error.what());
  }
  if (renderer) make_still_lists(info, scene, frame, candidates);
  check_all(info, candidates, checker);
  const json pictures = info.group.pictures ? pictures_of(info, *renderer, candidates) : json::object();
  if (renderer) time_group(info, *renderer, scene, candidates);

  std::vector<json> results;
  for (Candidate& candidate : candidates) {
    results.push_back(result_json(info, candidate, frame));
    if (const auto mirror = mirror_stats(renderer ? renderer->mirrored() : nullptr); mirror && candidate.lighting)
      results.back()["stats"]["mirror"] = to_json(*mirror);
    const std::string label = full_label(*candidate.entry);
    if (pictures.contains(label)) results.back()["pictures"] = pictures[label];
  }
  return results;
}

}  // namespace lamp::app
