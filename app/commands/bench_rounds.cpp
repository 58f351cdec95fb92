// Rounds: every candidate once a frame, all on the same lights, which move from frame to frame.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "bench/statistics.h"
#include "commands/bench_candidate.h"
#include "gpu/check.h"

namespace lamp::app {
namespace {

/// An entry whose frames took the GPU this long together has had enough of them once FEWEST_FRAMES are timed: one that
/// walks a million lights a pixel would take longer than all others together. A flight needs each of its frames.
constexpr double LONGEST_MS = 2000.0;
constexpr std::size_t FEWEST_FRAMES = 3;
/// How often a group is measured whose times say that the GPU's clock moved.
constexpr int MOST_TRIES = 3;

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
  return group.flight ? group.frames - 1 : group.frames + 1 + round;
}

/// Shadow maps are of another frame than the first that is timed, whose lights have moved since.
void draw_frame_before(const MeasureInfo& info, Renderer& renderer, BenchScene& scene, Candidate& candidate,
                       std::uint32_t round) {
  const std::uint32_t first = info.group.flight ? info.group.frames - 1 : info.group.frames;
  const std::uint32_t before = round == 0 ? first : frame_of_round(info.group, round - 1);
  const BenchFrame frame = bench_frame(scene, info.group, before);
  renderer.light_still(candidate.still_lists.get());
  renderer.set_frame(frame.views, frame.lights, frame.decals);
  renderer.warm_up(*candidate.lighting);
}

/// All candidates of a round draw what has moved since the round before, also shadow maps: none is given another's.
void time_rounds(const MeasureInfo& info, Renderer& renderer, BenchScene& scene, std::list<Candidate>& candidates) {
  const std::uint32_t rounds = info.group.warm_up + info.group.frames;
  // Lists of still lights change the order of lights, and shadow maps with it.
  const bool each_its_own =
      std::ranges::any_of(candidates, [](const Candidate& c) { return c.still_lists != nullptr; });
  const auto first = std::ranges::find_if(candidates, &Candidate::runs);
  if (first == candidates.end()) return;
  if (!each_its_own && info.group.warm_up == 0) draw_frame_before(info, renderer, scene, *first, 0);
  for (std::uint32_t round = 0; round < rounds; ++round) {
    const bool warm = round >= info.group.warm_up;
    const std::uint32_t number = frame_of_round(info.group, round);
    const BenchFrame frame = bench_frame(scene, info.group, number);
    if (!each_its_own) renderer.set_frame(frame.views, frame.lights, frame.decals);
    const Shadows::Pending pending = renderer.pending_shadows();
    for (Candidate& candidate : candidates) {
      say(info, "times " + full_label(*candidate.entry), 0.5 + 0.5 * static_cast<double>(round) / rounds);
      if (!candidate.runs() || has_enough(info, candidate, warm)) continue;
      if (each_its_own) {
        draw_frame_before(info, renderer, scene, candidate, round);
        renderer.set_frame(frame.views, frame.lights, frame.decals);
      } else {
        renderer.set_pending_shadows(pending);
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

}  // namespace

void say(const MeasureInfo& info, const std::string& what, double share) {
  if (const int signal = info.stop(); signal != 0) throw Interrupted{signal};
  info.progress(what, share);
}

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

}  // namespace lamp::app
