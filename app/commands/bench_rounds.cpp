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

/// Frames to get warm by, of rounds below 0, are others than the first that is timed: else what is drawn only where
/// something has moved, shadow maps, would be missing in that one.
std::uint32_t frame_of_round(const Group& group, int round) {
  if (round >= 0) return static_cast<std::uint32_t>(round);
  return group.flight ? group.frames - 1 : group.frames - static_cast<std::uint32_t>(round);
}

void draw_round(const MeasureInfo& info, Renderer& renderer, BenchScene& scene, Candidate& candidate, int round) {
  const BenchFrame frame = bench_frame(scene, info.group, frame_of_round(info.group, round));
  renderer.light_still(candidate.still_lists.get());
  renderer.set_frame(frame.views, frame.lights, frame.decals);
  renderer.warm_up(*candidate.lighting);
}

/// All candidates of a round draw what has moved since the round before, also shadow maps: none is given another's.
void time_rounds(const MeasureInfo& info, Renderer& renderer, BenchScene& scene, std::list<Candidate>& candidates) {
  const auto warm_up = static_cast<int>(info.group.warm_up);
  const auto rounds = static_cast<int>(info.group.frames);
  // Lists of still lights change the order of lights, and shadow maps with it.
  const bool each_its_own =
      std::ranges::any_of(candidates, [](const Candidate& c) { return c.still_lists != nullptr; });
  const auto first = std::ranges::find_if(candidates, &Candidate::runs);
  if (first == candidates.end()) return;
  if (!each_its_own && warm_up == 0) draw_round(info, renderer, scene, *first, -warm_up - 1);
  for (int round = -warm_up; round < rounds; ++round) {
    const bool warm = round >= 0;
    const std::uint32_t number = frame_of_round(info.group, round);
    const BenchFrame frame = bench_frame(scene, info.group, number);
    if (!each_its_own) renderer.set_frame(frame.views, frame.lights, frame.decals);
    const Shadows::Pending pending = renderer.pending_shadows();
    for (Candidate& candidate : candidates) {
      say(info, "times " + full_label(*candidate.entry),
          0.5 + 0.5 * (round + warm_up) / static_cast<double>(rounds + warm_up));
      if (!candidate.runs() || has_enough(info, candidate, warm)) continue;
      if (each_its_own) {
        draw_round(info, renderer, scene, candidate, round - 1);
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
