// Makes the candidates of a group, checks them, has them timed.
// SPDX-License-Identifier: Apache-2.0
#include "commands/bench_measure.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <list>
#include <memory>

#include "bench/results.h"
#include "commands/bench_candidate.h"
#include "commands/bench_pictures.h"
#include "commands/stats.h"
#include "gpu/check.h"

namespace lamp::app {
namespace {

using nlohmann::json;

/// The frame whose output is checked: the middle one, of a flight the one with the most lights.
std::uint32_t checked_frame(const Group& group) {
  if (!group.flight) return group.frames / 2;
  std::uint32_t best = 0;
  for (std::uint32_t i = 0; i < group.frames; ++i)
    if (lights_at(*group.flight, i, group.frames) > lights_at(*group.flight, best, group.frames)) best = i;
  return best;
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
  if (!is_auto(entry.name)) return entry;
  if (chosen.method == nullptr) throw Error("auto looks at a frame's depth, and nothing is rendered here");
  entry.name = chosen.method->name;
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
    } catch (const ShaderError&) {
      throw;
    } catch (const Error& error) {
      candidate.checked = {.verdict = "impossible", .reason = error.what()};
    }
  }
  return candidates;
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

void take_pictures(const MeasureInfo& info, Renderer& renderer, std::list<Candidate>& candidates, Checker& checker) {
  std::vector<Candidate*> shown;
  std::vector<BenchPicture> pictures;
  for (Candidate& candidate : candidates) {
    if (!candidate.lighting) continue;
    shown.push_back(&candidate);
    pictures.push_back({.label = full_label(*candidate.entry),
                        .key = key_of(info.group, *candidate.entry),
                        .lighting = &*candidate.lighting,
                        .still = candidate.still ? &*candidate.still : nullptr,
                        .show = [&] { checker.show(candidate.still_lists.get()); }});
  }
  if (shown.empty()) return;
  const std::vector<json> files = write_pictures(info.folder, info.group, renderer, pictures);
  for (std::size_t i = 0; i < shown.size(); ++i) shown[i]->pictures = files[i];
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
    } catch (const ShaderError&) {
      throw;
    } catch (const Error& error) {
      candidate.lighting.reset();
      candidate.checked = {.verdict = "impossible", .reason = error.what()};
    }
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
  } catch (const ShaderError&) {
    throw;
  } catch (const Error& error) {
    candidates = all_impossible(info.group, error.what());
  }
  if (renderer) make_still_lists(info, scene, frame, candidates);
  check_all(info, candidates, checker);
  if (info.group.pictures && checker) take_pictures(info, *renderer, candidates, *checker);
  if (renderer) time_group(info, *renderer, scene, candidates);

  std::vector<json> results;
  for (Candidate& candidate : candidates) {
    results.push_back(result_json(info, candidate, frame));
    if (const auto mirror = mirror_stats(renderer ? renderer->mirrored() : nullptr); mirror && candidate.lighting)
      results.back()["stats"]["mirror"] = to_json(*mirror);
    if (!candidate.pictures.is_null()) results.back()["pictures"] = std::move(candidate.pictures);
  }
  return results;
}

}  // namespace lamp::app
